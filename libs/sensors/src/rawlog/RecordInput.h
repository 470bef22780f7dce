#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <optional>
#include <string>

#include "quadmap/base/GzipInput.h"

namespace quadmap
{
/** The bytes of a rawlog, record by record. Those of the present record are kept, so that behind a
 * record which cannot be read the next one can be found: it begins with the name of a class. */
class RecordInput : public mrpt::io::CStream
{
 public:
  /** \exception std::runtime_error If the file cannot be opened. */
  explicit RecordInput(const std::string& file);
  /** See GzInput. */
  void setMostBytes(std::uint64_t most) { file_.setMostBytes(most); }

  /** What is read from here on is one record: only before its first byte may the file end. */
  void startRecord();
  /** The first bytes of the record, as far as they have been read. */
  const std::string& recordHead() const { return head_; }
  /** Why reading failed; empty while nothing did. */
  const std::string& failure() const { return failure_; }
  double progress() const { return file_.progress(); }

  /** Goes on where the next record seems to begin, behind the first byte of the present one.
   *  \return How many bytes were passed over; nothing when no record begins within kMostKept, or
   *  when the file has had kMostSearched bytes of records that could not be read. */
  std::optional<std::uint64_t> skipToNextRecord();

  /** Passes over the mark that ends an object, if it is next where a record should begin. */
  void passEndMark();

  /** \exception std::runtime_error If the file ends within a record, is damaged, or holds more than
   *  it may. */
  std::size_t Read(void* buffer, std::size_t count) override;
  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return file_.getTotalBytesCount(); }
  std::uint64_t getPosition() const override { return file_.getPosition() - bytes_.size() + next_; }

  /** Most bytes that are kept of a record. An image of 8 million pixels with depth has 40 MB. */
  static constexpr std::size_t kMostKept = std::size_t{1} << 26;
  /** They are read again, and a file can be made of nothing but beginnings of long records. Each
   * costs kTryBytes more, so that short ones cannot be too many. */
  static constexpr std::uint64_t kMostSearched = std::uint64_t{1} << 30;
  static constexpr std::uint64_t kTryBytes = std::uint64_t{1} << 16;

 private:
  void fetch(std::size_t least);
  bool isRecordAt(std::size_t at) const;

  GzInput file_;
  std::string bytes_;           //!< Of the record, and what was read ahead of it
  std::size_t begin_ = 0;       //!< Of the record in them
  std::size_t next_ = 0;        //!< The next byte to be read
  std::uint64_t searched_ = 0;  //!< Bytes of records that could not be read, altogether
  bool wasForgotten_ = false;   //!< The record is longer than what is kept
  std::string head_, failure_;
};

}  // namespace quadmap
