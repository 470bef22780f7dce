#pragma once

#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPlanes.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/pipeline/KeyframeTask.h"

namespace quadmap
{
/** Measures the boxes of keyframes, one after the other: remembers the room's surfaces. */
class PerceptionStage
{
 public:
  PerceptionStage(const SlamConfiguration& configuration, const LabelTable& labels) :
      method_(configuration.slam.method),
      options_(configuration.perception),
      perception_(configuration.perception, labels)
  {
  }

  /** \param T_map_odom Brings the task's pose where the robot is by the latest estimate.
   *  \exception std::runtime_error The frame is unusable. */
  void measure(KeyframeTask& task, const mrpt::poses::CPose3D& T_map_odom);

 private:
  SlamMethod method_;
  PerceptionOptions options_;
  FramePerception perception_;
  RoomPlanes room_;
};

}  // namespace quadmap
