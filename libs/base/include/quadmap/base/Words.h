#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace quadmap
{
/** The words of a line, which stand between blanks. A stream for each line would take most of the
 * time of reading a file. */
std::vector<std::string> wordsOf(std::string_view line);

/** A word of a file in quotes, for messages: as oneLine() shows it, and its beginning when it is
 * long. */
std::string quotedWord(const std::string& word);

/** The first few of some names and how many more there are: "a, b, c, d, e and 295 more". Long ones
 * are cut. */
std::string firstFew(const std::set<std::string>& names);

}  // namespace quadmap
