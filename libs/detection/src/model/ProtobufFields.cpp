#include "model/ProtobufFields.h"

#include <stdexcept>

namespace quadmap
{
namespace
{
[[noreturn]] void refuse() { throw std::runtime_error("is damaged, or no network in ONNX"); }
}  // namespace

std::uint64_t ProtobufFields::integer()
{
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7)
  {
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if ((byte & 0x80) == 0) return value;
  }
  refuse();
}

std::string_view ProtobufFields::take(std::uint64_t size)
{
  if (size > rest_.size()) refuse();
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

std::optional<ProtobufField> ProtobufFields::next()
{
  if (rest_.empty()) return std::nullopt;
  enum : std::uint64_t
  {
    kVariable = 0,
    kEightBytes = 1,
    kWithLength = 2,
    kFourBytes = 5
  };
  const std::uint64_t key = integer();
  if (key >> 32 != 0) refuse();  // other readers leave these bits out
  ProtobufField field;
  field.number = key >> 3;
  const auto set = [&field](ProtobufField::Form form, std::string_view bytes)
  {
    field.form = form;
    field.bytes = bytes;
  };
  switch (key & 7)
  {
    case kVariable:
      field.integer = integer();
      break;
    case kEightBytes:
      set(ProtobufField::Form::Fixed, take(8));
      break;
    case kWithLength:
      set(ProtobufField::Form::Bytes, take(integer()));
      break;
    case kFourBytes:
      set(ProtobufField::Form::Fixed, take(4));
      break;
    default:
      refuse();  // groups, which ONNX has none of
  }
  return field;
}

}  // namespace quadmap
