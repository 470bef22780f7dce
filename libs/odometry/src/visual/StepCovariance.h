#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "RigidMotion.h"

namespace quadmap
{
/** Covariance of the motion between two marked images. Each image was measured against a keyframe,
 * and each keyframe against the one before. All errors are small motions x in exp(x) T_map_image,
 * which simply add up: doc/mathematics.md, (15.9). */
class StepCovariance
{
 public:
  /** Sets the covariance of the latest image against its keyframe. */
  void setLatest(const Matrix6& toKeyframe) { latest_ = toKeyframe; }

  /** Adds the covariance of a new keyframe, or of a gap, against the keyframe before. */
  void addKeyframe(const Matrix6& toOldKeyframe)
  {
    keyframes_ += toOldKeyframe;
    latest_.setZero();
  }

  /** Covariance of the motion from the image of the last call to the latest one. */
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

/** A relative pose in MRPT's coordinates (x, y, z, yaw, pitch, roll). The given covariance is that
 * of x in exp(x) T. */
mrpt::poses::CPose3DPDFGaussian gaussianOf(
    const Eigen::Isometry3d& T_from_to, const Matrix6& covarianceInFrom);

}  // namespace quadmap
