#include "quadmap/perception/RoomPerception.h"

namespace quadmap
{
namespace
{
/** The map's z axis in the sensor frame. */
Eigen::Vector3d upOf(const mrpt::poses::CPose3D& T_map_sensor)
{
  return T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
}
}  // namespace

FrameSurfaces measureInRoom(
    const FramePerception& perception,
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor,
    const RoomPlanes& room)
{
  return perception.measure(scan, boxes, upOf(T_map_sensor), room.around(T_map_sensor));
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

std::vector<std::optional<BoxEvidence>> RoomPerception::edgeEvidence(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor) const
{
  return perception_.edgeEvidence(scan, boxes, upOf(T_map_sensor), room_.around(T_map_sensor));
}

}  // namespace quadmap
