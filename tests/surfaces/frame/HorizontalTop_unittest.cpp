#include "quadmap/surfaces/HorizontalTop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../SyntheticFrame.h"

using namespace quadmap;

namespace
{
constexpr double kHeight = 0.74, kCamera = 1.4;  // of the table, and of the camera [m]

LabelProperties table()
{
  LabelProperties p;
  p.name = "dining table";
  p.typicalSize = {1.4, 0.8, 0.75};
  p.sizeSpread = 0.3;
  p.levelTop = true;
  p.known = true;
  return p;
}

/** A table of this size 1.5 m ahead, with a book on it. */
SyntheticFrame frameWithTable(const Eigen::Vector2d& size)
{
  SyntheticFrame frame(kCamera, 0.5);
  frame.noise = 0.0012;
  frame.add(1.5, 0, kHeight - 0.04, 0.2, {size.x(), size.y(), 0.04});
  frame.add(1.5, 0.1 * size.y(), kHeight, 0, {0.2 * size.x(), 0.3 * size.y(), 0.02});
  return frame;
}

Eigen::Matrix3d opticalFromSensor()
{
  return T_sensor_optical().getRotationMatrix().asEigen().transpose();
}

Eigen::Vector3d upOf(const SyntheticFrame& frame)
{
  return opticalFromSensor() * frame.up_sensor();
}

/** The top found when up is wrong by this rotation vector. */
std::optional<Plane> topOf(const SyntheticFrame& frame, const Eigen::Vector3d& error)
{
  const auto scan = frame.scan();
  const SurfaceOptions options;
  const DepthCloud cloud(scan, options);
  const Eigen::Vector3d up = upOf(frame);
  std::vector<Eigen::Vector3d> points;
  for (int r = 0; r < cloud.rows(); ++r)
    for (int c = 0; c < cloud.columns(); ++c)
    {
      if (!cloud.valid(c, r)) continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      if (up.dot(p) > 0.3 - kCamera) points.push_back(p);  // not the floor's
    }
  const Eigen::Vector3d wrong = Eigen::AngleAxisd(error.norm(), error.normalized()) * up;
  return horizontalTop(cloud, points, 1, nullptr, wrong, table(), options);
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::acos(std::min(1.0, a.dot(b))) * 180 / M_PI;
}

}  // namespace

TEST(HorizontalTop, OfABroadTableTellsWhereUpIs)
{
  const SyntheticFrame frame = frameWithTable({1.0, 1.6});
  const Eigen::Vector3d up = upOf(frame);
  constexpr double kWrong = 1.2 * M_PI / 180;
  for (const Eigen::Vector3d& error :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(-1, 0, 0),
        Eigen::Vector3d(0, 0, 1)})
  {
    const auto top = topOf(frame, kWrong * error);
    ASSERT_TRUE(top);
    EXPECT_LT(angle_deg(top->n, up), 0.3) << error.transpose();
    const Eigen::Vector3d middle_world(1.5, 0, kHeight - frame.T_world_sensor.z());
    const Eigen::Matrix3d R = frame.T_world_sensor.getRotationMatrix().asEigen().transpose();
    EXPECT_NEAR(top->signedDistance(opticalFromSensor() * R * middle_world), 0, 0.003)
        << error.transpose();
  }
}

// Its points hardly tell a slope across: the noise would.
TEST(HorizontalTop, OfANarrowOneTakesUpFromThePose)
{
  const SyntheticFrame frame = frameWithTable({0.05, 1.6});
  constexpr double kWrong = 1.2 * M_PI / 180;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitX();  // of the image: turns up ahead or back
  for (const double sign : {-1, 1})
  {
    const auto top = topOf(frame, sign * kWrong * across);
    ASSERT_TRUE(top);
    EXPECT_LT(angle_deg(top->n, Eigen::AngleAxisd(sign * kWrong, across) * upOf(frame)), 0.6);
    EXPECT_GT(angle_deg(top->n, upOf(frame)), 0.6);
  }
}
