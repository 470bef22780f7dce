#include "rawlog/RecordInput.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "records/RecordCheck.h"
#include "records/UnreadableRecord.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kPieceBytes = 1u << 16;  // read ahead, as records are read byte by byte

/** Classes whose layout is not known here are none: see CheckedReader::tryNext(). */
bool isRecordClass(const std::string& writtenName)
{
  const auto* found = mrpt::rtti::findRegisteredClass(writtenName);
  if (!found) return false;
  return (found->derivedFrom(CLASS_ID(mrpt::obs::CObservation)) ||
          found->derivedFrom(CLASS_ID(mrpt::obs::CSensoryFrame)) ||
          found->derivedFrom(CLASS_ID(mrpt::obs::CActionCollection))) &&
         RecordCheck::mayTry(RecordCheck::classNamed(writtenName));
}
}  // namespace

RecordInput::RecordInput(const std::string& file) : file_(file) {}

void RecordInput::startRecord()
{
  begin_ = next_;
  wasForgotten_ = false;
  head_.clear();
  failure_.clear();
  if (begin_ <= bytes_.size() / 2) return;  // what is ahead is moved seldom
  bytes_.erase(0, begin_);
  begin_ = next_ = 0;
}

/** Reads the file until there are so many bytes or more, as far as it has them. */
void RecordInput::fetch(std::size_t least)
{
  const std::size_t before = bytes_.size();
  if (least <= before) return;
  const std::size_t size = std::max(least, before + kPieceBytes);
  bytes_.resize(size);
  std::size_t end = before;
  try
  {
    for (std::size_t got = 1; got > 0 && end < size; end += got)
      got = file_.readSome(bytes_.data() + end, size - end);
  }
  catch (const std::runtime_error& e)
  {
    failure_ = e.what();
  }
  bytes_.resize(end);
}

std::size_t RecordInput::Read(void* buffer, std::size_t count)
{
  if (next_ - begin_ > kMostKept)
  {
    bytes_.erase(0, next_);
    begin_ = next_ = 0;
    wasForgotten_ = true;
  }
  fetch(next_ + count);
  const std::size_t done = std::min(count, bytes_.size() - next_);
  std::memcpy(buffer, bytes_.data() + next_, done);
  if (head_.size() < GzInput::kHeadBytes)
    head_.append(bytes_, next_, std::min(done, GzInput::kHeadBytes - head_.size()));
  next_ += done;
  if (done < count && failure_.empty() && (next_ > begin_ || wasForgotten_))
    failure_ = "the file is truncated (it ends within a record)";
  if (done < count && !failure_.empty()) throw std::runtime_error(failure_);
  return done;
}

/** Whether MRPT may have written a record there: a byte with the length of a name and a mark, and
 * the name of a class of which records are. */
bool RecordInput::isRecordAt(std::size_t at) const
{
  constexpr unsigned kMark = 0x80;
  const auto first = static_cast<unsigned char>(bytes_[at]);
  const std::size_t length = first & ~kMark;
  if ((first & kMark) == 0 || length == 0 || length >= bytes_.size() - at) return false;
  const std::string_view name(bytes_.data() + at + 1, length);
  return isClassName(name) && isRecordClass(std::string(name));
}

std::optional<std::uint64_t> RecordInput::skipToNextRecord()
{
  searched_ += next_ - begin_ + kTryBytes;
  if (wasForgotten_ || searched_ > kMostSearched) return std::nullopt;
  for (std::size_t at = begin_ + 1; at - begin_ <= kMostKept; ++at)
  {
    if (at + GzInput::kHeadBytes > bytes_.size()) fetch(at + GzInput::kHeadBytes);
    if (at >= bytes_.size()) break;
    if (!isRecordAt(at)) continue;
    const std::uint64_t passed = at - begin_;
    next_ = at;
    startRecord();
    return passed;
  }
  return std::nullopt;
}

void RecordInput::passEndMark()
{
  constexpr char kEndMark = '\x88';  // it is also the head of a name of eight letters
  fetch(next_ + 2);
  const std::string_view two = std::string_view(bytes_).substr(next_, 2);
  if (!two.empty() && two[0] == kEndMark && !isClassName(two.substr(1))) ++next_;
}

std::size_t RecordInput::Write(const void*, std::size_t)
{
  throw std::logic_error("RecordInput: is read only");
}

std::uint64_t RecordInput::Seek(std::int64_t, TSeekOrigin)
{
  throw std::logic_error("RecordInput: cannot seek");
}

}  // namespace quadmap
