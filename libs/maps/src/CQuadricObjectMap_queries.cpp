#include <mrpt/core/format.h>
#include <mrpt/tfest/TMatchingPair.h>

#include <limits>
#include <sstream>
#include <stdexcept>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/maps/ObjectRecords.h"

namespace quadmap
{
std::vector<const MapObject*> CQuadricObjectMap::confirmedObjects() const
{
  std::vector<const MapObject*> found;
  for (const auto& [id, object] : objects_)
    if (object.confirmed) found.push_back(&object);
  return found;
}

const MapObject* CQuadricObjectMap::find(ObjectId id) const
{
  const auto it = objects_.find(id);
  return it == objects_.end() ? nullptr : &it->second;
}

std::vector<const MapObject*> CQuadricObjectMap::withLabel(const std::string& label) const
{
  const std::string wanted = labels().canonical(label);
  std::vector<const MapObject*> found;
  for (const auto* object : confirmedObjects())
    if (object->label() == wanted) found.push_back(object);
  return found;
}

std::vector<const MapObject*> CQuadricObjectMap::inRegion(
    const mrpt::math::TBoundingBox& region) const
{
  std::vector<const MapObject*> found;
  for (const auto* object : confirmedObjects())
  {
    const Eigen::Vector3d c = object->object.center();
    if (region.containsPoint({c.x(), c.y(), c.z()})) found.push_back(object);
  }
  return found;
}

const MapObject* CQuadricObjectMap::nearest(
    const mrpt::math::TPoint3D& p, const std::string& label) const
{
  const MapObject* best = nullptr;
  double bestDistance = std::numeric_limits<double>::infinity();
  for (const auto* object : label.empty() ? confirmedObjects() : withLabel(label))
  {
    const double distance = (object->object.center() - Eigen::Vector3d(p.x, p.y, p.z)).norm();
    if (distance >= bestDistance) continue;
    best = object;
    bestDistance = distance;
  }
  return best;
}

mrpt::math::TPolygon2D CQuadricObjectMap::footprint(ObjectId id) const
{
  const MapObject* object = find(id);
  if (!object) throw std::out_of_range(mrpt::format("the map has no object %u", id));
  const Eigen::Matrix<double, 3, 8> corners = object->object.cuboidCorners();
  mrpt::math::TPolygon2D outline;
  for (const Eigen::Index corner : {0, 1, 3, 2})
    outline.emplace_back(corners(0, corner), corners(1, corner));
  return outline;
}

mrpt::math::TBoundingBoxf CQuadricObjectMap::boundingBox() const
{
  const auto confirmed = confirmedObjects();
  if (confirmed.empty()) return {};
  auto box = mrpt::math::TBoundingBoxf::PlusMinusInfinity();
  for (const auto* object : confirmed)
  {
    const Eigen::Matrix<float, 3, 8> corners = object->object.cuboidCorners().cast<float>();
    for (Eigen::Index i = 0; i < 8; ++i)
      box.updateWithPoint({corners(0, i), corners(1, i), corners(2, i)});
  }
  return box;
}

std::vector<ObjectRecord> CQuadricObjectMap::toRecords() const
{
  std::vector<ObjectRecord> records;
  for (const auto* object : confirmedObjects()) records.push_back(recordOf(*object));
  return records;
}

std::string CQuadricObjectMap::asString() const
{
  std::ostringstream out;
  const auto confirmed = confirmedObjects();
  out << "CQuadricObjectMap with " << objects_.size() << " objects, " << confirmed.size()
      << " confirmed";
  for (const auto* object : confirmed)
  {
    const Eigen::Vector3d c = object->object.center(), size = 2 * object->object.semiAxes();
    out << mrpt::format(
        "\n  %4u %-16s at (%.2f, %.2f, %.2f) m, size %.2f x %.2f x %.2f m, seen %u times",
        object->id, object->label().c_str(), c.x(), c.y(), c.z(), size.x(), size.y(), size.z(),
        object->observations());
  }
  return out.str();
}

// Matching with another map ------------------------------------------------------------------

void CQuadricObjectMap::determineMatching3D(
    const mrpt::maps::CMetricMap* otherMap,
    const mrpt::poses::CPose3D& otherMapPose,
    mrpt::tfest::TMatchingPairList& correspondences,
    const mrpt::maps::TMatchingParams& params,
    mrpt::maps::TMatchingExtraResults& extraResults) const
{
  const auto* other = dynamic_cast<const CQuadricObjectMap*>(otherMap);
  if (!other)
    throw std::invalid_argument("CQuadricObjectMap: can be matched with its own class only");
  correspondences.clear();
  extraResults = mrpt::maps::TMatchingExtraResults();

  const auto theirs = other->confirmedObjects();
  for (const auto* there : theirs)
  {
    const Ellipsoid moved = there->object.transformed(otherMapPose);
    const MapObject* best = nullptr;
    double bestDistance = params.maxDistForCorrespondence;
    for (const auto* here : confirmedObjects())
    {
      const double distance = (here->object.center() - moved.center()).norm();
      if (distance > bestDistance || !labels().compatible(here->label(), there->label())) continue;
      best = here;
      bestDistance = distance;
    }
    if (!best) continue;
    const Eigen::Vector3d a = best->object.center(), b = there->object.center();
    correspondences.emplace_back(
        best->id, there->id, static_cast<float>(a.x()), static_cast<float>(a.y()),
        static_cast<float>(a.z()), static_cast<float>(b.x()), static_cast<float>(b.y()),
        static_cast<float>(b.z()));
    extraResults.sumSqrDist += static_cast<float>(bestDistance * bestDistance);
  }
  if (!theirs.empty())
    extraResults.correspondencesRatio =
        static_cast<float>(correspondences.size()) / static_cast<float>(theirs.size());
}

float CQuadricObjectMap::compute3DMatchingRatio(
    const mrpt::maps::CMetricMap* otherMap,
    const mrpt::poses::CPose3D& otherMapPose,
    const mrpt::maps::TMatchingRatioParams& params) const
{
  if (!dynamic_cast<const CQuadricObjectMap*>(otherMap)) return 0;
  mrpt::maps::TMatchingParams matching;
  matching.maxDistForCorrespondence = params.maxDistForCorr;
  mrpt::tfest::TMatchingPairList pairs;
  mrpt::maps::TMatchingExtraResults extra;
  determineMatching3D(otherMap, otherMapPose, pairs, matching, extra);
  return extra.correspondencesRatio;
}

}  // namespace quadmap
