#include "quadmap/slam/pipeline/PerceptionStage.h"

#include "quadmap/perception/BoxEdges.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
/** The map's z axis in the sensor frame. */
Eigen::Vector3d upInSensor(const CPose3D& T_map_sensor)
{
  return T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
}

}  // namespace

void PerceptionStage::measure(KeyframeTask& task, const CPose3D& T_map_odom)
{
  if (method_ == SlamMethod::Quadric)
  {
    measureWithoutDepth(*task.boxes, options_);
    return;
  }
  const auto& scan = *task.frame.scan;
  const CPose3D T_map_sensor = T_map_odom + task.T_odom_robot + scan.sensorPose;
  const auto surfaces =
      perception_.measure(scan, *task.boxes, upInSensor(T_map_sensor), room_.around(T_map_sensor));
  room_.add(surfaces, T_map_sensor);
}

}  // namespace quadmap
