#include "PerceptionStage.h"

#include "quadmap/perception/BoxEdges.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

void PerceptionStage::measure(KeyframeTask& task, const CPose3D& T_map_odom)
{
  if (method_ == SlamMethod::Quadric)
  {
    measureWithoutDepth(*task.boxes, options_);
    return;
  }
  const auto& scan = *task.frame.scan;
  perception_.measure(scan, *task.boxes, T_map_odom + task.T_odom_robot + scan.sensorPose);
}

}  // namespace quadmap
