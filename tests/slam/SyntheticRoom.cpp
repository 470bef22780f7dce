#include "SyntheticRoom.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** What the pixels of an image show: poses are taken apart once, not for each pixel. */
class Pixels
{
 public:
  Pixels(const SyntheticRoom& room, const mrpt::poses::CPose3D& T_map_optical) :
      camera_(room.camera),
      R_map_optical_(T_map_optical.getRotationMatrix().asEigen()),
      R_box_map_(room.box.rotation().transpose()),
      halfSizes_(room.box.semiAxes()),
      height_(T_map_optical.z())
  {
    const Eigen::Vector3d eye(T_map_optical.x(), T_map_optical.y(), T_map_optical.z());
    eye_box_ = R_box_map_ * (eye - room.box.center());
  }

  double depthAt(double u, double v) const
  {
    constexpr double kFarthest = 8.0;  // [m]
    const Eigen::Vector3d ray = R_map_optical_ * camera_.ray(u, v);
    const Eigen::Vector3d d = R_box_map_ * ray;
    double depth = ray.z() < 0 ? -height_ / ray.z() : 0;
    double enter = 0, leave = 1e9;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double half = halfSizes_[axis];
      const double t1 = (-half - eye_box_[axis]) / d[axis], t2 = (half - eye_box_[axis]) / d[axis];
      enter = std::max(enter, std::min(t1, t2));
      leave = std::min(leave, std::max(t1, t2));
    }
    if (enter < leave && (depth == 0 || enter < depth)) depth = enter;
    return depth < kFarthest ? depth : 0;
  }

 private:
  PinholeCamera camera_;
  Eigen::Matrix3d R_map_optical_, R_box_map_;
  Eigen::Vector3d halfSizes_, eye_box_;
  double height_;
};
}  // namespace

double SyntheticRoom::depthAt(const mrpt::poses::CPose3D& T_map_optical, double u, double v) const
{
  return Pixels(*this, T_map_optical).depthAt(u, v);
}

mrpt::obs::CObservation3DRangeScan::Ptr SyntheticRoom::scanFrom(
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
  const Pixels pixels(*this, T_map_robot + T_robot_camera + T_sensor_optical());
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u)
    {
      const double depth_mm = 1000 * pixels.depthAt(u, v);
      scan->rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(depth_mm));
      for (std::int8_t channel = 0; channel < 3; ++channel)
        scan->intensityImage.at<std::uint8_t>(u, v, channel) =
            static_cast<std::uint8_t>(static_cast<int>(depth_mm / 20));
    }
  return scan;
}

CObservationObjects::Ptr SyntheticRoom::boxesOf(
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

}  // namespace quadmap
