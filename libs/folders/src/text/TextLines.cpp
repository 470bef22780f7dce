#include "text/TextLines.h"

#include <mrpt/core/format.h>

#include <charconv>
#include <stdexcept>
#include <string_view>

#include "quadmap/base/InputFile.h"
#include "quadmap/base/Words.h"
#include "quadmap/obs/UnusableLines.h"

namespace quadmap
{
namespace
{
/** In memory a line takes many times its length. */
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 24;
/** Some editors put it before UTF-8. */
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
}  // namespace

std::vector<TextLine> readTextLines(const std::string& path, std::vector<std::string>* unusable)
{
  auto file = openModestText(path, kMostBytes);
  std::vector<TextLine> lines;
  std::size_t number = 0;
  for (std::string text; std::getline(file, text);)
  {
    if (++number == 1 && text.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0)
      text.erase(0, kByteOrderMark.size());
    const auto place = [&] { return path + ":" + std::to_string(number); };
    if (text.find('\0') != std::string::npos)
    {
      const std::string why = place() + ": is no text (UTF-16?)";
      if (!unusable) throw std::runtime_error(why);
      noteUnusable(*unusable, path, why);
      continue;
    }
    auto words = wordsOf(std::string_view(text).substr(0, text.find('#')));
    if (!words.empty()) lines.push_back({place(), std::move(words)});
  }
  if (file.bad()) throw std::runtime_error(path + ": read error");
  return lines;
}

void requireColumns(const TextLine& line, std::size_t columns)
{
  if (line.words.size() != columns)
    throw std::runtime_error(mrpt::format(
        "%s: expected %zu columns, got %zu", line.place.c_str(), columns, line.words.size()));
}

double numberIn(const TextLine& line, std::size_t column)
{
  const std::string& word = line.words[column];
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size())
    throw std::runtime_error(line.place + ": " + quotedWord(word) + " is not a number");
  return value;
}

double timeIn(const TextLine& line, std::size_t column)
{
  const double time = numberIn(line, column);
  if (!(time >= 0 && time <= kLatestTime))
    throw std::runtime_error(
        line.place + ": the time " + quotedWord(line.words[column]) + " must be in 0..1e10 s");
  return time;
}

}  // namespace quadmap
