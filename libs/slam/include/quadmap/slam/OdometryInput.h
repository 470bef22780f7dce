#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <optional>

#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
/** Gives every frame the pose it enters the estimation with. */
class OdometryInput
{
 public:
  explicit OdometryInput(PoseSource source) : source_(source) {}

  /** T_map_robot of the frame, or nothing when the input has none at its time. */
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);

  std::size_t framesWithoutPose() const { return framesWithoutPose_; }

  /** What to tell the user when no frame got a pose. */
  std::string whyNoPoses() const;

 private:
  PoseSource source_;
  std::size_t framesWithoutPose_ = 0;
  bool sawOdometry_ = false, sawGroundTruth_ = false;
};

}  // namespace quadmap
