#pragma once

#include "KeyframeTask.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/RoomPerception.h"
#include "quadmap/slam/SlamConfiguration.h"

namespace quadmap
{
/** Measures the boxes of keyframes, one after the other, and remembers the surfaces of the room. */
class PerceptionStage
{
 public:
  PerceptionStage(const SlamConfiguration& configuration, const LabelTable& labels) :
      method_(configuration.slam.method),
      options_(configuration.perception),
      perception_(configuration.perception, labels)
  {
  }

  /** \param T_map_odom Latest correction of the odometry.
   *  \exception std::runtime_error If the frame cannot be used. */
  void measure(KeyframeTask& task, const mrpt::poses::CPose3D& T_map_odom);

  const RoomPlanes& room() const { return perception_.room(); }  //!< Between keyframes

 private:
  SlamMethod method_;
  PerceptionOptions options_;
  RoomPerception perception_;
};

}  // namespace quadmap
