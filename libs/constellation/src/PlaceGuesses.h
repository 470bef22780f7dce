#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "quadmap/constellation/ConstellationOptions.h"
#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** Shift and yaw of the local frame in the map. */
struct Place
{
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  double yaw = 0;

  Eigen::Matrix3d R() const
  {
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
};

/** The objects of a run and of a map, and which may be the same by what they are. */
struct Constellations
{
  using Objects = std::vector<const MapObject*>;

  const Objects &local, &map;
  std::vector<std::vector<std::size_t>> alike;  //!< Objects of the map, for each local one

  bool bothHaveHeadings(std::size_t i, std::size_t j) const
  {
    return local[i]->orientationDefined && map[j]->orientationDefined;
  }
};

double yawOf(const MapObject& object);

/** Pairs of local objects that are held against pairs of the map's, at most: their number grows
 * with the fourth power of that of alike objects. */
constexpr std::size_t kMaxPairsOfPairs = 100000;

/** Where the local frame may be: wherever two objects are as far from each other as two of the map,
 * or one has a heading. Each two local objects have the same share of kMaxPairsOfPairs. Those that
 * could be more pairs of the map than their share are compared with every n-th pair only. */
std::vector<Place> guessPlaces(const Constellations& both, const ConstellationOptions& options);

}  // namespace quadmap
