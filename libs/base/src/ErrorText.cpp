#include "quadmap/base/ErrorText.h"

#include <cstddef>
#include <filesystem>

namespace quadmap
{
namespace
{
/** Lengths of a message [bytes]. A path may have 4,096, but two of them are hardly ever named. */
constexpr std::size_t kLongest = 1000, kKeptOfEnd = 200;

/** Number of bytes of the UTF-8 letter that starts here; 0 when none does. */
std::size_t letterBytes(const std::string& text, std::size_t at)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + count > text.size()) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  // Control characters above 0x80, overlong forms, surrogates, and numbers beyond the last letter
  const unsigned second = byte(at + 1);
  const bool isNone = (first == 0xC2 && second < 0xA0) || (first == 0xE0 && second < 0xA0) ||
                      (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
                      (first == 0xF4 && second > 0x8F);
  return isNone ? 0 : count;
}

/** Line breaks become a space, with the blanks around them. */
std::string printable(const std::string& text)
{
  std::string line;
  bool breaks = true;  // just after the start or a line break
  for (std::size_t i = 0; i < text.size();)
  {
    const bool isBreak = text[i] == '\n' || text[i] == '\r' || text[i] == '\t';
    const std::size_t bytes = letterBytes(text, i);
    if (isBreak)
    {
      line.erase(line.find_last_not_of(' ') + 1);
      breaks = true;
    }
    else if (text[i] != ' ' || !breaks)
    {
      if (breaks && !line.empty()) line += ' ';
      breaks = false;
      line += bytes > 0 ? text.substr(i, bytes) : "?";
    }
    i += bytes > 0 ? bytes : 1;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/** MRPT nests messages and call stacks; the innermost message is the cause. Where MRPT reads one of
 * our classes, it quotes what that threw. */
std::string innermost(const std::string& text)
{
  for (const std::string mark : {"Original exception:\n", "Message:  "})
  {
    const auto nested = text.rfind(mark);
    if (nested == std::string::npos) continue;
    const auto begin = text.find_first_not_of("\n\r ", nested + mark.size());
    if (begin == std::string::npos) return {};
    const auto line = text.substr(begin, text.find_first_of("\n\r", begin) - begin);
    if (line.rfind("==== MRPT", 0) != 0) return line;  // else it quotes a message of MRPT's
  }
  return text;
}

/** The innermost cause of "OpenCV(4.6.0) file:line: error: (code:name) cause in function 'f'". A
 * cause of several lines, which may quote another error, stands behind the function instead, each
 * line with "> " before it; the first one tells. */
std::string withoutPlace(const std::string& text)
{
  if (text.rfind("OpenCV(", 0) != 0) return text;
  const auto error = text.find(" error: (", text.rfind("OpenCV("));
  const auto end = error == std::string::npos ? error : text.find(") ", error);
  if (end == std::string::npos) return text;
  const std::string cause = text.substr(end + 2);
  if (cause.rfind("in function ", 0) != 0) return cause.substr(0, cause.find(" in function "));
  const auto lines = cause.find("\n> ");
  if (lines == std::string::npos) return text;
  const auto begin = lines + 3;
  return cause.substr(begin, cause.find('\n', begin) - begin);
}

}  // namespace

std::string oneLine(const std::string& text)
{
  // Of a text of many megabytes only the ends are looked at.
  const std::string ends = text.size() <= 2 * kLongest
                               ? text
                               : text.substr(0, kLongest) + text.substr(text.size() - kLongest);
  const std::string line = printable(ends);
  if (line.size() <= kLongest) return line;
  // A letter of several bytes that is cut becomes '?'.
  return printable(line.substr(0, kLongest - kKeptOfEnd)) + " ... " +
         printable(line.substr(line.size() - kKeptOfEnd));
}

std::string rootMessage(const std::exception& e)
{
  if (const auto* error = dynamic_cast<const std::filesystem::filesystem_error*>(&e))
    return oneLine(error->path1().string() + ": " + error->code().message());
  const std::string line = oneLine(withoutPlace(innermost(e.what())));
  return line.empty() ? "unknown error" : line;
}

}  // namespace quadmap
