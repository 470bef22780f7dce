#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/Plane.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** The box of one object in one image, in the map. */
struct PlacedBox
{
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Its centre [m]
  std::array<Plane, 4> edges;    //!< Left, top, right, bottom; normals towards the object
  std::array<bool, 4> usable{};  //!< Not cut by the border of the image

  Eigen::Vector3d forward() const;  //!< Middle of what the camera sees through the box, unit
};

/** Where the planes that halve the boxes meet, by least squares: near the object's centre.
 * \return Nothing when the boxes do not fix it, as from one place. */
std::optional<Eigen::Vector3d> triangulatedCenter(const std::vector<PlacedBox>& boxes);

/** The centres of the cameras [m]. */
std::vector<Eigen::Vector3d> camerasOf(const std::vector<PlacedBox>& boxes);

/** The ellipsoid that the usable edges touch, by linear least squares: each plane pi gives
 * pi^t Q* pi = 0 for the ten numbers of the symmetric Q* (Nicholson et al., 2019). z is the axis
 * that is nearest to the map's.
 * \return Nothing when there are fewer than three boxes or nine edges, when they leave more than
 * one Q*, or when Q* is not an ellipsoid. */
std::optional<Ellipsoid> ellipsoidTouching(const std::vector<PlacedBox>& boxes);

struct RenamedAxes
{
  Ellipsoid object;
  std::array<Eigen::Index, 3> order;  //!< Its axis i was number order[i]
};

/** The same axes, named such that z is the one that is nearest to up; right-handed. */
RenamedAxes withAxesNamedUpright(const Ellipsoid& object);

/** Every size is within so many spreads of the label's typical one (in the order of length), and
 * the whole object is in front of every camera. */
bool isPlausible(
    const Ellipsoid& object,
    const std::vector<PlacedBox>& boxes,
    const LabelProperties& label,
    double maxSizeDeviation);

}  // namespace quadmap
