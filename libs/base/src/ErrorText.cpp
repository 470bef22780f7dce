#include "quadmap/base/ErrorText.h"

namespace quadmap
{
std::string rootMessage(const std::exception& e)
{
  // MRPT nests messages and call stacks; the innermost message is the cause.
  const std::string text = e.what(), mark = "Message:  ";
  const auto nested = text.rfind(mark);
  const auto begin =
      text.find_first_not_of("\n\r ", nested == std::string::npos ? 0 : nested + mark.size());
  if (begin == std::string::npos) return "unknown error";
  return text.substr(begin, text.find_first_of("\n\r", begin) - begin);
}

}  // namespace quadmap
