#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadmap
{
/** The words of a line, which stand between blanks. A stream for each line would take most of the
 * time of reading a file. */
std::vector<std::string> wordsOf(std::string_view line);

}  // namespace quadmap
