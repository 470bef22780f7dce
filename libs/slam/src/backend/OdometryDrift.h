#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "quadmap/constellation/Drift.h"
#include "quadmap/graph/StepNoise.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** How far the odometry alone may have drifted between keyframes: doc/mathematics.md, (16.23).
 *
 * What one keyframe sees is moved, relative to what an earlier one sees, by the errors of all steps
 * between them: v + w x p at the place p of the map [m], with the turn w [rad] and the shift v [m]
 * about the map's origin. */
class OdometryDrift : public Drift
{
 public:
  /** \param noise How many times as much as they claim the steps err by. A keyframe without a step
   * counts as one that did not drift: nothing is closed that needs it. */
  OdometryDrift(const std::vector<Keyframe>& keyframes, const StepNoise& noise);

  Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const override;

 private:
  std::vector<Eigen::Matrix<double, 6, 6>> upTo_;  //!< Of (v, w), from the first keyframe on
};

}  // namespace quadmap
