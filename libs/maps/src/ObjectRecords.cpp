#include "quadmap/maps/ObjectRecords.h"

namespace quadmap
{
ObjectRecord recordOf(const MapObject& object)
{
  ObjectRecord r;
  r.id = std::to_string(object.id);
  r.label = object.label();
  r.object = object.object;
  r.orientationDefined = object.orientationDefined;
  r.observations = object.observations();
  r.existence = object.existence();
  r.labelCounts = object.labelCounts;
  r.covariance = object.covariance;
  return r;
}

}  // namespace quadmap
