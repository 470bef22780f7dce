#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "RigidMotion.h"

namespace quadmap
{
/** How well the motion between two marked images is known, when each image is measured against a
 * keyframe and keyframes against each other. All errors are small motions x in exp(x) T_map_...:
 * in the frame of the map they simply add up. */
class StepCovariance
{
 public:
  /** The latest image lies to its keyframe with this error. */
  void setLatest(const Matrix6& toKeyframe) { latest_ = toKeyframe; }

  /** A new keyframe, or a step into the unknown, follows the old keyframe with this error. */
  void addKeyframe(const Matrix6& toOldKeyframe)
  {
    keyframes_ += toOldKeyframe;
    latest_.setZero();
  }

  /** Covariance of the way from the image of the last call to the latest one. */
  Matrix6 take()
  {
    const Matrix6 sum = start_ + keyframes_ + latest_;
    start_ = latest_;
    keyframes_.setZero();
    return sum;
  }

 private:
  Matrix6 start_ = Matrix6::Zero(), keyframes_ = Matrix6::Zero(), latest_ = Matrix6::Zero();
};

/** A relative pose whose error is exp(x) T with covariance of x, in MRPT's coordinates (x, y, z,
 * yaw, pitch, roll). */
mrpt::poses::CPose3DPDFGaussian gaussianOf(
    const Eigen::Isometry3d& T_from_to, const Matrix6& covarianceInFrom);

}  // namespace quadmap
