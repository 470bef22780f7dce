#pragma once

#include <string>

namespace quadmap
{
/** Whether two names of outputs, which need not exist, lead to the same file: by another spelling,
 * by links, or as the same pipe. A device such as /dev/null takes any number of outputs: its name
 * is not the same output as any other. */
bool isSameOutput(const std::string& one, const std::string& other);

/** Whether an output is where this program prints: /dev/stdout, or another name of that. It is
 * false for /dev/null, which takes both. Ask before the output is written: a file is replaced by
 * that. */
bool isStandardOutput(const std::string& path);

}  // namespace quadmap
