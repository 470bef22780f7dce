#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** \exception std::runtime_error If no detector calls a class so: for names of more than 200 bytes,
 * or with control characters. \param place "file:line", for the message. */
void requireClassName(const std::string& name, const std::string& place);

/** The lines of a file with names of classes, the first of which is class 0, without blanks around
 * them and without empty lines. \exception std::runtime_error If it cannot be read, or one is
 * no name; names the file. */
std::vector<std::string> readClassNames(const std::string& path);

}  // namespace quadmap
