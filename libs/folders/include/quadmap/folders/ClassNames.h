#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** The lines of a file with names of classes, the first of which is class 0, without blanks around
 * them and without empty lines. \exception std::runtime_error If it cannot be read; names it. */
std::vector<std::string> readClassNames(const std::string& path);

}  // namespace quadmap
