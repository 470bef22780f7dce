#pragma once

#include <string>

namespace quadmap
{
/** Whether two names of outputs, which need not exist, lead to the same file: by another spelling,
 * by links, or as the same pipe. A device such as /dev/null takes any number of outputs: its name
 * is not the same output as any other. */
bool isSameOutput(const std::string& one, const std::string& other);

}  // namespace quadmap
