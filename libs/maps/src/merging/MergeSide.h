#pragma once

#include <Eigen/Dense>
#include <set>
#include <vector>

#include "merging/MergePlan.h"

namespace quadmap
{
/** The outline, from above, of where a map has objects. */
class MapRegion
{
 public:
  explicit MapRegion(const std::vector<const MapObject*>& objects);
  bool contains(const Eigen::Vector2d& p) const;

 private:
  std::vector<Eigen::Vector2d> hull_;
};

/** A map and the frames it was made of; all in the frame of the own map. */
struct MergeSide
{
  MergeSide() = default;
  MergeSide(MergeSide&&) = default;  // a copy would point into the original
  MergeSide& operator=(MergeSide&&) = default;

  bool isOwn = false;
  std::vector<MapObject> copies;                      //!< Confirmed objects
  std::vector<const MapObject*> confirmed, unpaired;  //!< Of these
  mrpt::poses::CPose3D T_own_map;
  const MatchedFrames* frames = nullptr;
};

/** \param paired Ids of what the other map has as well. */
MergeSide sideOf(
    const MergedMap& map,
    const std::set<ObjectId>& paired,
    const mrpt::poses::CPose3D& T_own_map,
    const MatchedFrames& frames);

}  // namespace quadmap
