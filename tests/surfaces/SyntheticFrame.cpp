#include "SyntheticFrame.h"

#include <algorithm>
#include <limits>
#include <random>

namespace quadmap
{
namespace
{
/** What the pixels show: poses are taken apart once, not for each pixel. */
class Pixels
{
 public:
  explicit Pixels(const SyntheticFrame& frame) :
      camera_(pinholeFrom(frame.camera)), hasFloor_(frame.hasFloor)
  {
    const mrpt::poses::CPose3D T_world_optical = frame.T_world_sensor + T_sensor_optical();
    R_ = T_world_optical.getRotationMatrix().asEigen();
    const auto& T = frame.T_world_sensor;
    eye_ = {T.x(), T.y(), T.z()};
    for (const auto& box : frame.boxes)
    {
      const Eigen::Matrix3d R_box_world = box.cuboid.rotation().transpose();
      boxes_.push_back(
          {R_box_world, R_box_world * (eye_ - box.cuboid.center()), box.cuboid.semiAxes()});
    }
  }

  std::pair<int, double> look(unsigned u, unsigned v) const
  {
    const Eigen::Vector3d d = R_ * camera_.ray(u, v);
    std::pair<int, double> hit = {-2, std::numeric_limits<double>::infinity()};
    if (hasFloor_ && d.z() < 0) hit = {-1, -eye_.z() / d.z()};
    for (std::size_t i = 0; i < boxes_.size(); ++i)
    {
      const Eigen::Vector3d& ob = boxes_[i].eye;
      const Eigen::Vector3d db = boxes_[i].R_box_world * d;
      double enter = 0, leave = hit.second;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double a = (-boxes_[i].halfSizes[axis] - ob[axis]) / db[axis];
        const double b = (boxes_[i].halfSizes[axis] - ob[axis]) / db[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter < leave && enter > 0 && enter < hit.second) hit = {static_cast<int>(i), enter};
    }
    return hit;
  }

 private:
  struct Box
  {
    Eigen::Matrix3d R_box_world;
    Eigen::Vector3d eye, halfSizes;  // in the frame of the box
  };

  PinholeCamera camera_;
  bool hasFloor_;
  Eigen::Matrix3d R_;  // of the optical frame in the world
  Eigen::Vector3d eye_;
  std::vector<Box> boxes_;
};
}  // namespace

std::pair<int, double> SyntheticFrame::look(unsigned u, unsigned v) const
{
  return Pixels(*this).look(u, v);
}

mrpt::obs::CObservation3DRangeScan SyntheticFrame::scan() const
{
  mrpt::obs::CObservation3DRangeScan out;
  out.hasRangeImage = true;
  out.range_is_depth = true;
  out.rangeUnits = 1e-4f;
  out.rangeImage_setSize(static_cast<int>(camera.nrows), static_cast<int>(camera.ncols));
  out.cameraParams = camera;
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const Pixels pixels(*this);
  for (unsigned v = 0; v < camera.nrows; ++v)
    for (unsigned u = 0; u < camera.ncols; ++u)
    {
      const auto [box, z] = pixels.look(u, v);
      const double measured = z + noise * z * z * normal(generator);
      const bool returns = box < 0 || boxes[static_cast<std::size_t>(box)].hasDepth;
      const bool seen = returns && measured > 0 && measured < 6.5;
      out.rangeImage(static_cast<int>(v), static_cast<int>(u)) =
          seen ? static_cast<std::uint16_t>(measured / 1e-4) : std::uint16_t(0);
    }
  return out;
}

DetectedObject SyntheticFrame::detect(std::size_t index, const std::string& label) const
{
  DetectedObject out;
  out.label = label;
  out.box = {1e9, 1e9, -1e9, -1e9};
  const Pixels pixels(*this);
  for (unsigned v = 0; v < camera.nrows; ++v)
    for (unsigned u = 0; u < camera.ncols; ++u)
      if (pixels.look(u, v).first == static_cast<int>(index))
        out.box = {
            std::min(out.box.x1, double(u)), std::min(out.box.y1, double(v)),
            std::max(out.box.x2, double(u)), std::max(out.box.y2, double(v))};
  return out;
}

}  // namespace quadmap
