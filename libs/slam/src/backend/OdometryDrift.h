#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "quadmap/graph/StepNoise.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** How far the odometry alone may have drifted between keyframes: doc/mathematics.md, (16.23).
 *
 * What one keyframe sees is moved, relative to what an earlier one sees, by the errors of all steps
 * between them: v + w x p at the place p of the map [m], with the turn w [rad] and the shift v [m]
 * about the map's origin. */
class OdometryDrift
{
 public:
  /** \param noise How many times as much as they claim the steps err by. A keyframe without a step
   * counts as one that did not drift: nothing is closed that needs it. */
  OdometryDrift(const std::vector<Keyframe>& keyframes, const StepNoise& noise);

  /** How far two things of the map are moved, each from where it was seen before. */
  struct Moved
  {
    Eigen::Vector3d place;              //!< In the map [m]
    std::size_t before = 0, again = 0;  //!< Keyframes, in this order
  };
  /** Covariance of the moves of two things [m^2]: the steps that both have between their keyframes
   * move both. */
  Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const;

 private:
  std::vector<Eigen::Matrix<double, 6, 6>> upTo_;  //!< Of (v, w), from the first keyframe on
};

}  // namespace quadmap
