#include "frames/DepthRegistration.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
constexpr double kFactor = 1000;  // depth in millimetres

mrpt::img::TCamera camera(double f, double cx, double cy)
{
  mrpt::img::TCamera c;
  c.setIntrinsicParamsFromValues(f, f, cx, cy);
  c.ncols = 160;
  c.nrows = 120;
  return c;
}

/** A depth camera beside and a little turned from the colour camera. */
DepthCamera besideColor()
{
  return {camera(150, 80, 60), mrpt::poses::CPose3D(-0.05, 0.01, 0.02, 0.02, -0.01, 0.03)};
}
}  // namespace

TEST(DepthRegistration, PutsAPlaneWhereTheColourCameraSeesIt)
{
  // The plane n . p = 2 m in the colour camera's frame. Both cameras are asked for its depth along
  // their rays: an oracle that knows nothing of pixels moving.
  const Eigen::Vector3d n = Eigen::Vector3d(0.1, -0.2, 1).normalized();
  const DepthCamera depth = besideColor();
  const auto color = camera(120, 79.5, 59.5);
  const Eigen::Matrix3d R = depth.T_color_depth.getRotationMatrix().asEigen();
  const Eigen::Vector3d t(
      depth.T_color_depth.x(), depth.T_color_depth.y(), depth.T_color_depth.z());
  const auto rayOf = [](const mrpt::img::TCamera& c, int u, int v)
  { return Eigen::Vector3d((u - c.cx()) / c.fx(), (v - c.cy()) / c.fy(), 1); };
  cv::Mat raw(120, 160, CV_16UC1);
  for (int v = 0; v < raw.rows; ++v)
    for (int u = 0; u < raw.cols; ++u)
      raw.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(
          std::lround(kFactor * (2 - n.dot(t)) / n.dot(R * rayOf(depth.camera, u, v))));
  const cv::Mat registered = registeredDepth(raw, depth, color, kFactor);
  ASSERT_EQ(registered.size(), cv::Size(160, 120));
  int filled = 0;
  for (int v = 20; v < 100; ++v)  // where both cameras look
    for (int u = 25; u < 135; ++u)
    {
      const double z = registered.at<std::uint16_t>(v, u);
      if (z == 0) continue;
      ++filled;
      // Half a pixel beside, the plane is 2 m * 0.22 * 0.5 / 120 = 2 mm nearer or farther.
      EXPECT_NEAR(z, kFactor * 2 / n.dot(rayOf(color, u, v)), 4) << u << "," << v;
    }
  EXPECT_GT(filled, 0.97 * 80 * 110) << "the colour camera has the shorter focal length";
}

TEST(DepthRegistration, KeepsTheNearestOfWhatMeetsInAPixel)
{
  DepthCamera depth = besideColor();
  // Seen from 0.1 m to either side, points at 1 m and 1.875 m move by 15 and by 8 pixels; the
  // nearer one comes first in the row from the one side, and last from the other.
  for (const int side : {-1, 1})
  {
    depth.T_color_depth = mrpt::poses::CPose3D(0.1 * side, 0, 0, 0, 0, 0);
    cv::Mat raw(120, 160, CV_16UC1, cv::Scalar(0));
    raw.at<std::uint16_t>(60, 80 - 15 * side) = 1000;
    raw.at<std::uint16_t>(60, 80 - 8 * side) = 1875;
    const cv::Mat registered = registeredDepth(raw, depth, camera(150, 80, 60), kFactor);
    EXPECT_EQ(registered.at<std::uint16_t>(60, 80), 1000) << side;
    EXPECT_EQ(cv::countNonZero(registered), 1) << "nothing was measured elsewhere";
  }
}

TEST(DepthRegistration, LeavesOutWhatIsBehindOrBesideTheColourCamera)
{
  DepthCamera depth = besideColor();
  depth.T_color_depth = mrpt::poses::CPose3D(0, 0, -1.5, 0, 0, 0);
  const cv::Mat raw(120, 160, CV_16UC1, cv::Scalar(1000));
  EXPECT_EQ(cv::countNonZero(registeredDepth(raw, depth, camera(150, 80, 60), kFactor)), 0);
  depth.T_color_depth = mrpt::poses::CPose3D(5, 0, 0, 0, 0, 0);
  EXPECT_EQ(cv::countNonZero(registeredDepth(raw, depth, camera(150, 80, 60), kFactor)), 0);
}
