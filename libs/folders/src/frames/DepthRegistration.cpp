#include "frames/DepthRegistration.h"

#include <cmath>
#include <limits>

namespace quadmap
{
cv::Mat registeredDepth(
    const cv::Mat& raw,
    const DepthCamera& depth,
    const mrpt::img::TCamera& color,
    double depthFactor)
{
  const Eigen::Matrix3d R = depth.T_color_depth.getRotationMatrix().asEigen();
  const Eigen::Vector3d t =  // in steps of the depth image, as the depths are
      depthFactor *
      Eigen::Vector3d(depth.T_color_depth.x(), depth.T_color_depth.y(), depth.T_color_depth.z());
  const auto& from = depth.camera;
  constexpr double kDeepest = std::numeric_limits<std::uint16_t>::max();
  cv::Mat registered(
      static_cast<int>(color.nrows), static_cast<int>(color.ncols), CV_16UC1, cv::Scalar(0));
  for (int v = 0; v < raw.rows; ++v)
  {
    const auto* row = raw.ptr<std::uint16_t>(v);
    const Eigen::Vector3d rowRay = R * Eigen::Vector3d(0, (v - from.cy()) / from.fy(), 1);
    for (int u = 0; u < raw.cols; ++u)
    {
      if (row[u] == 0) continue;
      const Eigen::Vector3d ray = rowRay + R.col(0) * ((u - from.cx()) / from.fx());
      const Eigen::Vector3d p = row[u] * ray + t;  // (24.1)
      const double z = std::round(p.z());
      if (!(z >= 1 && z <= kDeepest)) continue;
      const double x = std::round(color.fx() * p.x() / p.z() + color.cx());
      const double y = std::round(color.fy() * p.y() / p.z() + color.cy());
      if (!(x >= 0 && x < color.ncols && y >= 0 && y < color.nrows)) continue;
      auto& pixel = registered.at<std::uint16_t>(static_cast<int>(y), static_cast<int>(x));
      if (pixel == 0 || z < pixel) pixel = static_cast<std::uint16_t>(z);
    }
  }
  return registered;
}

}  // namespace quadmap
