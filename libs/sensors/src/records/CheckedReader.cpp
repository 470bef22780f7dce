#include "quadmap/sensors/CheckedReader.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include "records/MemoryGuard.h"
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
  if (!RecordCheck::knows(head.name))
  {
    const MemoryGuard guard;
    bytes.rereadFrom(head.begin);
    return mrpt::serialization::archiveFrom(bytes).ReadObject();
  }
  check.content(head);
  bytes.rereadFrom(head.begin);
  return mrpt::serialization::archiveFrom(bytes).ReadObject();
}

}  // namespace quadmap
