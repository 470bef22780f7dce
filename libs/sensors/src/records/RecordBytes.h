#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace quadmap
{
/** The bytes of one stored object, copied from a stream as far as they were asked for. A statement
 * about a size takes no memory until that many bytes were there. Numbers are little endian. */
class RecordBytes
{
 public:
  RecordBytes(mrpt::io::CStream& from, std::uint64_t mostBytes);

  /** Copies the first byte. \return False at the end of the stream. */
  bool begin();

  /** Copies n bytes more. \exception std::runtime_error For more than the object may have. */
  void copy(std::uint64_t n);

  /** Passes n bytes by, which take no memory. \exception std::runtime_error As for copy(). */
  void skip(std::uint64_t n);

  template <typename T>
  T number()
  {
    static_assert(std::is_arithmetic_v<T>);
    copy(sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data() + bytes_.size() - sizeof(T), sizeof(T));
    return value;
  }

  std::size_t size() const { return bytes_.size(); }
  std::uint8_t* at(std::size_t index) { return bytes_.data() + index; }
  /** Puts other bytes in place of those from `index` on. */
  void replaceFrom(std::size_t index, const std::vector<std::uint8_t>& bytes);

 private:
  mrpt::io::CStream& from_;
  std::uint64_t mostBytes_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace quadmap
