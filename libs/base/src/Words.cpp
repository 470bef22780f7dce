#include "quadmap/base/Words.h"

#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
/** A text as oneLine() shows it, without its end when it is long. */
std::string shortened(const std::string& text)
{
  constexpr std::size_t kShown = 60;  // [bytes]
  if (text.size() <= kShown) return oneLine(text);
  const auto continuesLetter = [&](std::size_t i) { return (text[i] & 0xC0) == 0x80; };
  std::size_t end = kShown;
  while (end > kShown - 4 && continuesLetter(end)) --end;  // letters have up to four bytes
  return oneLine(text.substr(0, end)) + "...";
}
}  // namespace

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

std::string quotedWord(const std::string& word) { return "'" + shortened(word) + "'"; }

std::string firstFew(const std::set<std::string>& names)
{
  constexpr std::size_t kFew = 5;
  std::string text;
  std::size_t shown = 0;
  for (auto name = names.begin(); name != names.end() && shown < kFew; ++name, ++shown)
    text += (shown == 0 ? "" : ", ") + shortened(*name);
  if (names.size() > kFew) text += " and " + std::to_string(names.size() - kFew) + " more";
  return text;
}

}  // namespace quadmap
