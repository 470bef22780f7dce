#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "../sensors/SampleRawlog.h"
#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/PinholeCamera.h"

namespace quadmap
{
/** A cuboid on an infinite floor, seen by a camera on a robot that drives around it. Depth comes
 * from exact intersections of rays, and the detector's boxes from the projected corners. */
struct SyntheticRoom
{
  Ellipsoid box{
      mrpt::poses::CPose3D(0.2, -0.1, 0.3, 0.35, 0, 0), {0.4, 0.25, 0.3}
  };
  std::string label = "suitcase";
  std::string sensor = "camera";
  mrpt::poses::CPose3D T_robot_camera{0.1, 0, 1.3, 0, 0.45, 0};  // looks down a little
  PinholeCamera camera{260, 260, 159.5, 119.5, 320, 240};

  /** Pose of the robot on a circle around the cuboid, facing it. \param angle Place on the circle
   *  [rad]. */
  mrpt::poses::CPose3D robotAt(double angle) const
  {
    constexpr double kRadius = 2.3;  // [m]
    const Eigen::Vector3d c = box.center();
    return {c.x() + kRadius * std::cos(angle),
            c.y() + kRadius * std::sin(angle),
            0,
            angle + M_PI,
            0,
            0};
  }

  /** Depth along the optical axis [m]. */
  double depthAt(const mrpt::poses::CPose3D& T_map_optical, double u, double v) const;

  mrpt::obs::CObservation3DRangeScan::Ptr scanFrom(
      const mrpt::poses::CPose3D& T_map_robot, double time) const;

  CObservationObjects::Ptr boxesOf(
      const mrpt::obs::CObservation3DRangeScan& scan,
      const mrpt::poses::CPose3D& T_map_robot) const;
};

/** Options of a synthetic recording. */
struct SyntheticRecording
{
  int frames = 6;
  bool odometry = true, groundTruth = false, boxes = true;
  double step = 0.25;  // between frames, along the circle [rad]
};

/** All records of a recording in the order of a rawlog, with embedded boxes. */
inline std::vector<mrpt::serialization::CSerializable::Ptr> recordsOf(
    const SyntheticRoom& room, const SyntheticRecording& recording)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < recording.frames; ++i)
  {
    const double time = kStart + 0.2 * i;
    const auto pose = room.robotAt(recording.step * i);
    if (recording.odometry) records.push_back(samplePose(time, pose));
    if (recording.groundTruth) records.push_back(samplePose(time, pose, "ground_truth"));
    const auto scan = room.scanFrom(pose, time);
    records.push_back(scan);
    if (recording.boxes) records.push_back(room.boxesOf(*scan, pose));
  }
  return records;
}

/** Writes a recording. \return The path. */
inline std::string writeRecording(
    const std::string& path,
    const SyntheticRecording& recording = {},
    const SyntheticRoom& room = {})
{
  return writeObjects(path, recordsOf(room, recording));
}

}  // namespace quadmap
