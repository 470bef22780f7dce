#include "relocalization/ClaimTogether.h"

#include "quadmap/estimation/AxisRenaming.h"

namespace quadmap
{
void claimTogether(
    const CQuadricObjectMap& given,
    const CQuadricObjectMap& own,
    const std::map<ObjectId, ObjectId>& heirs,
    CQuadricObjectMap& map)
{
  std::map<ObjectId, UprightCovariance> together;  // of the heirs
  const auto add = [&](ObjectId heir, const MapObject* knows)
  {
    const MapObject* now = map.find(heir);
    if (!knows || !now) return;
    const UprightCovariance P =
        axisRenaming(uprightStateOf(knows->object), uprightStateOf(now->object)).P;
    const UprightCovariance renamed = P * knows->covariance * P.transpose();
    const auto [at, isFirst] = together.emplace(heir, renamed);
    if (!isFirst) at->second = covarianceIntersection(at->second, renamed);
  };
  for (const auto& [object, heir] : heirs) add(heir, own.find(object));
  for (const auto& entry : std::map<ObjectId, UprightCovariance>(together))
    add(entry.first, given.find(entry.first));
  for (const auto& [heir, covariance] : together)
  {
    const UprightCovariance measured = map.find(heir)->covariance - map.sharedError(heir);
    map.setSharedError(heir, withoutNegative(covariance - measured));
  }
}

}  // namespace quadmap
