#include "quadmap/sensors/CheckedReader.h"

#include <mrpt/obs/CObservation.h>

#include "quadmap/sensors/MemoryGuard.h"
#include "records/RecordBytes.h"
#include "records/RecordCheck.h"

namespace quadmap
{
CheckedReader::CheckedReader(mrpt::io::CStream& from, const RecordLimits& limits) :
    from_(from), limits_(limits)
{
}

mrpt::serialization::CSerializable::Ptr CheckedReader::next() { return read(false); }

mrpt::serialization::CSerializable::Ptr CheckedReader::tryNext() { return read(true); }

mrpt::serialization::CSerializable::Ptr CheckedReader::read(bool isTry)
{
  RecordBytes bytes(from_, limits_.recordBytes);
  if (!bytes.begin()) return nullptr;
  RecordCheck check(bytes, limits_);
  const bool refusesUnknown = isTry || !MemoryGuard::isSafe();
  check.refusesUnknown = refusesUnknown;
  const auto head = check.headAfterFirstByte();
  // Callers would take the null pointer for the end of the file.
  RecordCheck::require(head.name != "nullptr", "holds an empty object");
  mrpt::serialization::CSerializable::Ptr object;
  if (RecordCheck::knows(head.name))
  {
    check.content(head);
    object = check.readByMrpt(head.begin);
  }
  else
  {
    check.refusesUnknown = refusesUnknown && !RecordCheck::mayTry(head.name);
    object = check.readUnknown(head);
  }
  if (check.damage.empty()) return object;
  DamagedImage error(check.damage);
  if (const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
    error.sensor = observation->sensorLabel;
  throw error;
}

}  // namespace quadmap
