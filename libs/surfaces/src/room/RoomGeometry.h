#pragma once

#include <Eigen/Dense>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
inline constexpr double kSameFloor = 0.10;   // [m]; pose noise and slope over a room
inline constexpr double kMinUpright = 0.95;  // cosine: horizontal surfaces

/** The mean of the samples of a patch, of which there is at least one [m]. */
inline Eigen::Vector3d centroidOf(const SurfacePatch& patch)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : patch.samples) sum += p.cast<double>();
  return sum / static_cast<double>(patch.samples.size());
}

}  // namespace quadmap
