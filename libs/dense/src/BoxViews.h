#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/sensors/ResultKeyframes.h"

namespace quadmap
{
/** One box of an object: where its usable edges say that the object is. */
struct BoxView
{
  PinholeCamera camera;
  Eigen::Isometry3d T_optical_map = Eigen::Isometry3d::Identity();
  ImageBox box;
  std::array<bool, 4> usable{};  //!< Left, top, right, bottom edge: the object really ends there

  Eigen::Vector3d eye() const { return T_optical_map.inverse().translation(); }  //!< In the map [m]

  /** Whether a point of the map lies within the usable edges; nothing when the image does not show
   * where it is. */
  std::optional<bool> contains(const Eigen::Vector3d& p_map) const;
};

/** The box of an object in an image; nothing when perception could make nothing of it. */
std::optional<BoxView> boxViewOf(const KeyframeScan& image, std::size_t box);

/** Share of the views in whose boxes a point lies, of those whose image shows where it is: equation
 * (22.1). It is zero when fewer than a quarter of them do, and in no view. */
double boxShare(const std::vector<BoxView>& views, const Eigen::Vector3d& p_map);

}  // namespace quadmap
