#include "quadmap/base/Words.h"

namespace quadmap
{
std::vector<std::string> wordsOf(std::string_view line)
{
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  std::vector<std::string> words;
  for (auto begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;)
  {
    const auto end = line.find_first_of(kBlanks, begin);
    words.emplace_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

}  // namespace quadmap
