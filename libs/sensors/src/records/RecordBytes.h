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
class RecordBytes : public mrpt::io::CStream
{
 public:
  RecordBytes(mrpt::io::CStream& from, std::uint64_t mostBytes);

  /** Copies the first byte. \return False at the end of the stream. */
  bool begin();

  /** Copies n bytes more. \exception std::runtime_error For more than the object may have. */
  void copy(std::uint64_t n);

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

  /** What was copied from `index` on is read first, then the rest of the stream, which is copied,
   * too. */
  void rereadFrom(std::size_t index) { next_ = index; }
  std::size_t Read(void* buffer, std::size_t count) override;

  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return bytes_.size(); }
  std::uint64_t getPosition() const override { return next_; }

 private:
  mrpt::io::CStream& from_;
  std::uint64_t mostBytes_;
  std::vector<std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

}  // namespace quadmap
