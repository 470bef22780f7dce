#include "rawlog/RecordReader.h"

#include <utility>

#include "InputError.h"
#include "records/UnreadableRecord.h"

namespace quadmap
{
namespace
{
/** What a rawlog may hold [bytes], and in how many records. Recordings of images compress to a
 * third, boxes to a fourteenth, and the poses of a robot that stands still to a fiftieth, with a
 * record in five bytes: an hour of these stays within what is always read. A file that holds more
 * was made to keep its reader busy: 13 MB can hold 13 GB, or 60 million records. */
std::uint64_t mostBytesIn(std::uint64_t fileBytes)
{
  constexpr std::uint64_t kAlways = std::uint64_t{1} << 27, kMostPerByte = 20;
  return kAlways + kMostPerByte * fileBytes;
}

std::uint64_t mostRecordsIn(std::uint64_t fileBytes)
{
  constexpr std::uint64_t kAlways = 200000, kLeastBytes = 8;  // of a record, beyond the first ones
  return kAlways + fileBytes / kLeastBytes;
}
}  // namespace

RecordReader::RecordReader(
    const std::string& file, const RecordLimits& limits, std::function<bool()> isStopped) :
    file_(file), stream_(file), reader_(stream_, limits), isStopped_(std::move(isStopped))
{
  stream_.setMostBytes(mostBytesIn(stream_.getTotalBytesCount()));
}

std::string RecordReader::explain(const std::exception& e) const
{
  const auto& head = stream_.recordHead();
  if (recordsRead_ == 0 && classNameIn(head).empty() && stream_.failure().empty())
    return "is no MRPT object: this is not a rawlog";
  return whyUnreadable(head, stream_.failure(), e);
}

mrpt::serialization::CSerializable::Ptr RecordReader::next()
{
  if (ended_) return nullptr;
  if (recordsRead_ > mostRecordsIn(stream_.getTotalBytesCount()))
  {
    ended_ = true;
    throw InputError({file_, recordsRead_, "", "the file has too many records for its size"});
  }
  const auto object = std::exchange(isLost_, false) ? findNext() : read();
  if (object)
    ++recordsRead_;
  else
    ended_ = true;
  return object;
}

mrpt::serialization::CSerializable::Ptr RecordReader::read()
{
  // The objects in one that is lost are found, and behind the last of them it ends.
  if (bytesLeftOut_ > 0) stream_.passEndMark();
  stream_.startRecord();
  try
  {
    return reader_.next();
  }
  catch (const DamagedImage& e)
  {
    throwDamaged(e);
  }
  catch (const std::exception& e)
  {
    isLost_ = true;
    const std::string why = explain(e);
    throw InputError({file_, recordsRead_++, "", why});
  }
}

void RecordReader::throwDamaged(const DamagedImage& e)
{
  const std::string why = explain(e);
  throw InputError({file_, recordsRead_++, e.sensor, why});
}

/** Finds the next object behind one that could not be read. Bytes that only look like the beginning
 * of one, as in an image, are tried and left out with the others.
 * \return Null when there is no further object. */
mrpt::serialization::CSerializable::Ptr RecordReader::findNext()
{
  std::uint64_t passedInAll = 0;
  while (const auto passed = stream_.skipToNextRecord())
  {
    passedInAll += *passed;
    try
    {
      const auto object = reader_.tryNext();
      bytesLeftOut_ += passedInAll;
      return object;
    }
    catch (const DamagedImage& e)
    {
      bytesLeftOut_ += passedInAll;
      throwDamaged(e);
    }
    catch (const std::exception&)
    {
      if (isStopped_()) break;
    }
  }
  return nullptr;
}

}  // namespace quadmap
