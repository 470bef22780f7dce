#pragma once

#include <mrpt/io/CStream.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

namespace quadmap
{
class GzipDecoder;

/** Reads a file, gzip-compressed or not. Unlike MRPT's stream it tells the clean end of a file from
 * a truncated or damaged one, or one that goes on with other bytes, and knows how much of the
 * compressed file has been read. */
class GzInput : public mrpt::io::CStream
{
 public:
  /** \param isResult False for a file that never is a result by itself, as an image in a folder of
   *  thousands. For a result the folder is searched for what a killed program left.
   *  \exception std::runtime_error If the file cannot be opened, or is a result that belongs to two
   *  runs (requireOneRun()). */
  explicit GzInput(const std::string& path, bool isResult = true);
  ~GzInput() override;
  GzInput(const GzInput&) = delete;
  GzInput& operator=(const GzInput&) = delete;

  /** A small compressed file may hold gigabytes. From now on no more than this is read of it. */
  void setMostBytes(std::uint64_t most) { mostBytes_ = most; }

  /** What is read from here on is one record: only before its first byte may the file end. */
  void startRecord();
  /** The first bytes of the record, as far as they have been read. */
  const std::string& recordHead() const { return head_; }
  std::uint64_t recordBytes() const { return recordBytes_; }
  /** Why reading failed; empty while nothing did. */
  const std::string& failure() const { return failure_; }
  double progress() const;  //!< Share of the file read, in [0, 1]

  /** \exception std::runtime_error If the file ends within a record, is damaged, or holds more than
   *  setMostBytes() allows. */
  std::size_t Read(void* buffer, std::size_t count) override;
  /** Reads as much as there is, less than `count` at the end of the file, or where it breaks off.
   * Then the next call tells which: it returns 0, or throws. Records do not matter.
   *  \exception std::runtime_error If the file is damaged, or holds more than setMostBytes()
   *  allows. */
  std::size_t readSome(char* bytes, std::size_t count);
  /** Reads to the end, whatever is there. \return How many bytes that were.
   *  \exception std::runtime_error If the file is damaged. */
  std::uint64_t skipToEnd();
  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return fileBytes_; }
  std::uint64_t getPosition() const override { return position_; }

  static constexpr std::size_t kHeadBytes = 160;  //!< More than a class name of MRPT can have

 private:
  [[noreturn]] void fail(const std::string& why);
  std::size_t readAvailable(char* bytes, std::size_t count);

  std::unique_ptr<GzipDecoder> decoder_;
  std::uint64_t fileBytes_ = 0, position_ = 0, recordBytes_ = 0;
  std::uint64_t mostBytes_ = std::numeric_limits<std::uint64_t>::max();
  std::string head_, failure_;
};

}  // namespace quadmap
