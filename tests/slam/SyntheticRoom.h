#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
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
  double depthAt(const mrpt::poses::CPose3D& T_map_optical, double u, double v) const
  {
    const Eigen::Matrix3d R = T_map_optical.getRotationMatrix().asEigen();
    const Eigen::Vector3d eye(T_map_optical.x(), T_map_optical.y(), T_map_optical.z());
    const Eigen::Vector3d ray = R * camera.ray(u, v);
    double depth = ray.z() < 0 ? -eye.z() / ray.z() : 0;
    const Eigen::Vector3d e = box.rotation().transpose() * (eye - box.center());
    const Eigen::Vector3d d = box.rotation().transpose() * ray;
    double enter = 0, leave = 1e9;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = box.semiAxes()[axis];
      const double t1 = (-half - e[axis]) / d[axis], t2 = (half - e[axis]) / d[axis];
      enter = std::max(enter, std::min(t1, t2));
      leave = std::min(leave, std::max(t1, t2));
    }
    if (enter < leave && (depth == 0 || enter < depth)) depth = enter;
    return depth < 8.0 ? depth : 0;
  }

  mrpt::obs::CObservation3DRangeScan::Ptr scanFrom(
      const mrpt::poses::CPose3D& T_map_robot, double time) const
  {
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->timestamp = stamp(time);
    scan->sensorLabel = sensor;
    scan->sensorPose = T_robot_camera;
    scan->cameraParams.ncols = camera.width;
    scan->cameraParams.nrows = camera.height;
    scan->cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    scan->cameraParamsIntensity = scan->cameraParams;
    scan->hasRangeImage = scan->hasIntensityImage = true;
    scan->range_is_depth = true;
    scan->rangeUnits = 0.001f;
    const int rows = static_cast<int>(camera.height), columns = static_cast<int>(camera.width);
    scan->rangeImage_setSize(rows, columns);
    scan->intensityImage.resize(camera.width, camera.height, mrpt::img::CH_RGB);
    const auto T_map_optical = T_map_robot + T_robot_camera + T_sensor_optical();
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u)
      {
        const double depth_mm = 1000 * depthAt(T_map_optical, u, v);
        scan->rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(depth_mm));
        for (std::int8_t channel = 0; channel < 3; ++channel)
          scan->intensityImage.at<std::uint8_t>(u, v, channel) =
              static_cast<std::uint8_t>(static_cast<int>(depth_mm / 20));
      }
    return scan;
  }

  CObservationObjects::Ptr boxesOf(
      const mrpt::obs::CObservation3DRangeScan& scan, const mrpt::poses::CPose3D& T_map_robot) const
  {
    auto boxes = CObservationObjects::Create();
    boxes->timestamp = scan.timestamp;
    boxes->sensorLabel = scan.sensorLabel;
    boxes->sensorPose = scan.sensorPose;
    boxes->cameraParams = scan.cameraParams;
    const auto T_map_optical = T_map_robot + T_robot_camera + T_sensor_optical();
    ImageBox b{1e9, 1e9, -1e9, -1e9};
    const auto corners = box.cuboidCorners();
    for (int i = 0; i < 8; ++i)
    {
      mrpt::math::TPoint3D p;
      T_map_optical.inverseComposePoint(
          mrpt::math::TPoint3D(corners(0, i), corners(1, i), corners(2, i)), p);
      const Eigen::Vector2d pixel = camera.project({p.x, p.y, p.z});
      b = {
          std::min(b.x1, pixel.x()), std::min(b.y1, pixel.y()), std::max(b.x2, pixel.x()),
          std::max(b.y2, pixel.y())};
    }
    boxes->objects.resize(1);
    boxes->objects[0].label = label;
    boxes->objects[0].score = 0.9;
    boxes->objects[0].box = b;
    return boxes;
  }
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
