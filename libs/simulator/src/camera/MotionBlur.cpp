#include "camera/MotionBlur.h"

#include <algorithm>
#include <cmath>

#include "camera/SeenPrimitive.h"

namespace quadmap::simulator
{
namespace
{
constexpr int kMostSamples = 32;

/** The pixels between the two ends of a motion, averaged. */
Eigen::Vector3d averageAlong(
    const RenderedFrame& frame, const Eigen::Vector2d& middle, const Eigen::Vector2d& motion)
{
  const int samples = std::clamp(static_cast<int>(std::ceil(motion.norm())), 1, kMostSamples);
  const int right = static_cast<int>(frame.camera.width) - 1;
  const int bottom = static_cast<int>(frame.camera.height) - 1;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < samples; ++k)
  {
    const Eigen::Vector2d p = middle + ((k + 0.5) / samples - 0.5) * motion;
    const int u = std::clamp(static_cast<int>(std::lround(p.x())), 0, right);
    const int v = std::clamp(static_cast<int>(std::lround(p.y())), 0, bottom);
    const std::uint8_t* rgb = &frame.rgb[3 * static_cast<std::size_t>(v * (right + 1) + u)];
    sum += Eigen::Vector3d(rgb[0], rgb[1], rgb[2]);
  }
  return sum / samples;
}

}  // namespace

void blurByMotion(RenderedFrame& frame, const mrpt::poses::CPose3D& T_start_end)
{
  // Of a point in the optical frame at the end of the exposure: where it was at its start.
  const Transform T((T_start_end + T_sensor_optical()) - T_sensor_optical());
  const Eigen::Matrix3d rays = inverseOf(frame.camera);
  const int width = static_cast<int>(frame.camera.width);
  const int height = static_cast<int>(frame.camera.height);
  std::vector<std::uint8_t> blurred(frame.rgb.size());
  double sum = 0;
  std::size_t i = 0;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u, ++i)
    {
      const Eigen::Vector3d point =
          static_cast<double>(frame.depth[i]) * (rays * Eigen::Vector3d(u, v, 1));
      const Eigen::Vector3d before = T.R * point + T.t;
      Eigen::Vector2d motion(0, 0);
      if (before.z() > 0.05)
        motion = Eigen::Vector2d(
            u - frame.camera.fx * before.x() / before.z() - frame.camera.cx,
            v - frame.camera.fy * before.y() / before.z() - frame.camera.cy);
      sum += motion.norm();
      const Eigen::Vector3d rgb = averageAlong(frame, {u, v}, motion);
      for (int c = 0; c < 3; ++c)
        blurred[3 * i + static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::lround(rgb[c]));
    }
  frame.rgb = std::move(blurred);
  frame.blur = sum / static_cast<double>(i);
}

}  // namespace quadmap::simulator
