#include "merging/MergeSide.h"

#include "quadmap/geometry/ConvexHull.h"

namespace quadmap
{
MapRegion::MapRegion(const std::vector<const MapObject*>& objects)
{
  std::vector<Eigen::Vector2d> corners;
  for (const MapObject* object : objects)
  {
    const Eigen::Matrix<double, 3, 8> all = object->object.cuboidCorners();
    for (Eigen::Index i = 0; i < all.cols(); ++i) corners.emplace_back(all.col(i).head<2>());
  }
  if (!corners.empty()) hull_ = convexHull(std::move(corners));
}

bool MapRegion::contains(const Eigen::Vector2d& p) const
{
  for (std::size_t i = 0; i < hull_.size(); ++i)
    if (cross(hull_[(i + 1) % hull_.size()] - hull_[i], p - hull_[i]) < 0) return false;
  return hull_.size() > 2;
}

MergeSide sideOf(
    const MergedMap& map,
    const std::set<ObjectId>& paired,
    const mrpt::poses::CPose3D& T_own_map,
    const MatchedFrames& frames)
{
  MergeSide side;
  side.T_own_map = T_own_map;
  side.frames = &frames;
  for (const MapObject* object : map.confirmed())
  {
    side.copies.push_back(*object);
    side.copies.back().object = object->object.transformed(T_own_map);
  }
  for (const MapObject& object : side.copies)
  {
    side.confirmed.push_back(&object);
    if (paired.count(object.id) == 0) side.unpaired.push_back(&object);
  }
  return side;
}

}  // namespace quadmap
