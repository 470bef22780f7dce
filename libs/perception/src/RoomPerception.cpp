#include "quadmap/perception/RoomPerception.h"

namespace quadmap
{
FrameSurfaces measureInRoom(
    const FramePerception& perception,
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor,
    const RoomPlanes& room)
{
  // The map's z axis in the sensor frame.
  const Eigen::Vector3d up_sensor = T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
  return perception.measure(scan, boxes, up_sensor, room.around(T_map_sensor));
}

FrameSurfaces measureAndRemember(
    const FramePerception& perception,
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor,
    RoomPlanes& room)
{
  FrameSurfaces surfaces = measureInRoom(perception, scan, boxes, T_map_sensor, room);
  room.add(surfaces, T_map_sensor);
  return surfaces;
}

}  // namespace quadmap
