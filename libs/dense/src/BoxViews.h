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
struct DenseBoxView
{
  PinholeCamera camera;
  Eigen::Isometry3d T_optical_map = Eigen::Isometry3d::Identity();
  ImageBox box;
  std::array<bool, 4> usable{};  //!< Left, top, right, bottom edge: the object really ends there

  Eigen::Vector3d eye() const { return T_optical_map.inverse().translation(); }  //!< In the map [m]

  /** Whether a point of the map is in the box. It is not when it lies beyond a usable edge. Nothing
   * is known of a point beyond another edge or outside the image. */
  std::optional<bool> contains(const Eigen::Vector3d& p_map) const;
};

/** The box of an object in an image; nothing when perception could make nothing of it. */
std::optional<DenseBoxView> boxViewOf(const KeyframeScan& image, std::size_t box);

/** Share of the views in whose boxes a point lies, of those that tell: equation (22.1). It is zero
 * for a point in the boxes of less than a quarter of all views. */
double boxShare(const std::vector<DenseBoxView>& views, const Eigen::Vector3d& p_map);

}  // namespace quadmap
