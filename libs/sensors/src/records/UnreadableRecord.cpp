#include "records/UnreadableRecord.h"

#include <algorithm>
#include <cctype>

#include "quadmap/base/ErrorText.h"
#include "records/RecordCheck.h"

namespace quadmap
{
bool isClassName(std::string_view name)
{
  const auto isLegal = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ':'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), isLegal);
}

std::string classNameIn(const std::string& head)
{
  constexpr std::size_t kNew = 1,
                        kOld = 4;  // size of the name's length in MRPT's two formats [bytes]
  if (head.empty()) return {};
  const auto first = static_cast<unsigned char>(head[0]);
  const bool isNew = (first & 0x80u) != 0;
  const std::size_t length = isNew ? first & 0x7Fu : first, start = isNew ? kNew : kOld;
  if (length == 0 || head.size() < start + length) return {};
  const std::string name = head.substr(start, length);
  return isClassName(name) ? name : std::string();
}

std::string whyUnreadable(
    const std::string& head, const std::string& failure, const std::exception& thrown)
{
  const std::string name = classNameIn(head);
  if (name.empty()) return failure.empty() ? "is no MRPT object: the file is damaged" : failure;
  if (!failure.empty()) return name + ": " + failure;
  if (!RecordCheck::reads(RecordCheck::classNamed(name)))
    return "class " + name + " is unknown, and MRPT files do not tell where such an object ends";
  return name + " cannot be read: " + rootMessage(thrown);
}

}  // namespace quadmap
