#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace quadmap
{
/** A field of a message in the wire format of Protocol Buffers. A reader that expects another form
 * of it ignores the field. */
struct ProtobufField
{
  enum class Form
  {
    Integer,  //!< Of variable length
    Bytes,    //!< A text, a message or packed numbers
    Fixed     //!< A number of 4 or 8 bytes
  };
  std::uint64_t number = 0;
  Form form = Form::Integer;
  std::uint64_t integer = 0;
  std::string_view bytes;  //!< Of the other two forms
};

/** Takes the fields of a message one after another. */
class ProtobufFields
{
 public:
  explicit ProtobufFields(std::string_view message) : rest_(message) {}

  /** The next field; nothing at the end.
   *  \exception std::runtime_error If the message is damaged. */
  std::optional<ProtobufField> next();

  /** The next integer of variable length, for packed ones. \exception std::runtime_error As above.
   */
  std::uint64_t integer();

  bool isAtEnd() const { return rest_.empty(); }

 private:
  std::string_view take(std::uint64_t size);

  std::string_view rest_;
};

}  // namespace quadmap
