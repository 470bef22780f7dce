#include "quadmap/sensors/CheckedReader.h"

#include "records/RecordBytes.h"
#include "records/RecordCheck.h"

namespace quadmap
{
CheckedReader::CheckedReader(mrpt::io::CStream& from, const RecordLimits& limits) :
    from_(from), limits_(limits)
{
}

mrpt::serialization::CSerializable::Ptr CheckedReader::next()
{
  RecordBytes bytes(from_, limits_.recordBytes);
  if (!bytes.begin()) return nullptr;
  RecordCheck check(bytes, limits_);
  const auto head = check.headAfterFirstByte();
  // Callers would take the null pointer for the end of the file.
  RecordCheck::require(head.name != "nullptr", "holds an empty object");
  if (!RecordCheck::knows(head.name)) return check.readUnknown(head.begin);
  check.content(head);
  return check.readByMrpt(head.begin);
}

}  // namespace quadmap
