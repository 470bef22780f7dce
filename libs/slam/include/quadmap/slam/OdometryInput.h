#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <optional>
#include <string>

#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
/** Gives every frame the pose it enters the estimation with, and keyframes the edge between them.
 */
class OdometryInput
{
 public:
  OdometryInput(PoseSource source, const PoseUncertaintyOptions& uncertainty) :
      source_(source), uncertainty_(uncertainty)
  {
  }

  /** T_map_robot of the frame, or nothing when the input has none at its time. */
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);

  /** To be called once for every keyframe, after poseOf() gave its pose: the motion of the robot
   * since the keyframe before, with its covariance (x, y, z, yaw, pitch, roll), always positive
   * definite. Nothing for the first keyframe. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> keyframeStep();

  /** What to tell the user when no frame got a pose. */
  std::string whyNoPoses() const;

 private:
  PoseSource source_;
  PoseUncertaintyOptions uncertainty_;
  std::optional<mrpt::poses::CPose3DPDFGaussian> latest_, keyframe_;  //!< Poses, as given
  bool sawOdometry_ = false, sawGroundTruth_ = false;
};

}  // namespace quadmap
