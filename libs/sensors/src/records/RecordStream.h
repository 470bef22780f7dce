#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <exception>

#include "records/RecordCheck.h"

namespace quadmap
{
/** What MRPT reads an object from. The object may be of a class whose layout is not known here, and
 * hold others. Before MRPT sees the content of one whose layout is known, that layout is followed
 * as everywhere. One of a class of which no objects are read is refused. How deeply MRPT calls
 * itself is limited: each level needs bytes, so this can be tested where they are read.
 *
 * MRPT hides the reason why reading failed; rethrowRefusal() tells it. */
class RecordStream : public mrpt::io::CStream
{
 public:
  /** \param check Has to outlive this.
   *  \param begin Index of the object's first byte. What was copied from there on counts as
   *  checked. */
  RecordStream(RecordCheck& check, std::size_t begin);

  /** \exception std::exception If the stream ends, or holds what is refused. Then nothing more is
   *  read. */
  std::size_t Read(void* buffer, std::size_t count) override;

  /** Throws again what Read() threw; does nothing when it did not. */
  void rethrowRefusal() const;

  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return check_.bytes.size(); }
  std::uint64_t getPosition() const override { return next_; }

 private:
  void copyTo(void* buffer, std::size_t count);
  void checkObjectNamedBy(std::size_t length);
  void requireShallow() const;

  RecordCheck& check_;
  std::size_t next_;               // index of the next byte
  std::size_t bytesReadLast_ = 0;  // of the read before this one
  std::uintptr_t stackAtStart_;
  std::exception_ptr refusal_;
};

}  // namespace quadmap
