#include "quadmap/maps/ObjectRecords.h"

#include <optional>

namespace quadmap
{
namespace
{
/** [s since 1970]; nothing for an object that was made by hand and never seen. */
std::optional<double> secondsOf(mrpt::Clock::time_point time)
{
  if (time == mrpt::Clock::time_point()) return std::nullopt;
  return mrpt::Clock::toDouble(time);
}
}  // namespace

ObjectRecord recordOf(const MapObject& object)
{
  ObjectRecord r;
  r.id = std::to_string(object.id);
  r.label = object.label();
  r.object = object.object;
  r.orientationDefined = object.orientationDefined;
  r.observations = object.observations();
  r.existence = object.existence();
  r.firstSeen = secondsOf(object.firstSeen);
  r.lastSeen = secondsOf(object.lastSeen);
  r.labelCounts = object.labelCounts;
  r.covariance = object.covariance;
  return r;
}

}  // namespace quadmap
