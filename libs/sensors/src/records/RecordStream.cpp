#include "records/RecordStream.h"

#include <mrpt/rtti/CObject.h>

#include <cstring>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** Most stack that MRPT may take to read an object [bytes]. Objects in objects take about a
 * kilobyte each; a thread has 8 MB. */
constexpr std::uintptr_t kMostStack = 1u << 19;

std::uintptr_t stackNow() { return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)); }
}  // namespace

RecordStream::RecordStream(RecordCheck& check, std::size_t begin) :
    check_(check), next_(begin), stackAtStart_(stackNow())
{
}

std::size_t RecordStream::Read(void* buffer, std::size_t count)
{
  rethrowRefusal();
  try
  {
    copyTo(buffer, count);
    return count;
  }
  catch (...)
  {
    refusal_ = std::current_exception();
    throw;
  }
}

void RecordStream::copyTo(void* buffer, std::size_t count)
{
  requireShallow();
  RecordBytes& bytes = check_.bytes;
  const bool areNew = next_ + count > bytes.size();
  if (areNew) bytes.copy(next_ + count - bytes.size());
  std::memcpy(buffer, bytes.at(next_), count);
  next_ += count;
  if (areNew) checkObjectNamedBy(count);
  bytesReadLast_ = count;
}

/** Checks the object that begins before the bytes that were read last, if they are the name of a
 * class. MRPT reads the length of the name, and then the name; before 0.5.5 (2008) the length had
 * three more bytes, which it reads in between. */
void RecordStream::checkObjectNamedBy(std::size_t length)
{
  constexpr std::size_t kRestOfOldLength = 3;
  const auto lengthIs = [&](std::size_t bytesBefore, std::size_t value)
  { return *check_.bytes.at(next_ - length - bytesBefore) == value; };
  if (bytesReadLast_ == 1 && lengthIs(1, RecordCheck::kHeadMark | length))
    check_.contentAfterName(next_ - length - 1);
  if (bytesReadLast_ == kRestOfOldLength && lengthIs(1 + kRestOfOldLength, length))
    RecordCheck::require(
        !mrpt::rtti::findRegisteredClass(check_.writtenNameAt(next_ - length, length)),
        "holds an object in a form that MRPT no longer writes");
}

void RecordStream::requireShallow() const
{
  const std::uintptr_t now = stackNow();
  const std::uintptr_t taken = now < stackAtStart_ ? stackAtStart_ - now : now - stackAtStart_;
  RecordCheck::require(taken <= kMostStack, "objects are nested in each other too deeply");
}

void RecordStream::rethrowRefusal() const
{
  if (refusal_) std::rethrow_exception(refusal_);
}

std::size_t RecordStream::Write(const void*, std::size_t)
{
  throw std::logic_error("RecordStream: is read only");
}

std::uint64_t RecordStream::Seek(std::int64_t, TSeekOrigin)
{
  throw std::logic_error("RecordStream: cannot seek");
}

}  // namespace quadmap
