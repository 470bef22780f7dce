#include "quadmap/surfaces/HorizontalTop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../SyntheticFrame.h"

using namespace quadmap;

namespace
{
constexpr double kHeight = 0.74;  // of the table [m]

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
  SyntheticFrame frame(1.4, 0.5);
  frame.noise = 0.0012;
  frame.add(1.5, 0, kHeight - 0.04, 0.2, {size.x(), size.y(), 0.04});
  frame.add(1.5, 0.1 * size.y(), kHeight, 0, {0.2 * size.x(), 0.3 * size.y(), 0.02});
  return frame;
}

/** The top found when up is wrong by this rotation vector. */
std::optional<Plane> topOf(const SyntheticFrame& frame, const Eigen::Vector3d& error)
{
  const auto scan = frame.scan();
  const SurfaceOptions options;
  const DepthCloud cloud(scan, options);
  const Eigen::Vector3d up =
      T_sensor_optical().getRotationMatrix().asEigen().transpose() * frame.up_sensor();
  std::vector<Eigen::Vector3d> points;
  for (int r = 0; r < cloud.rows(); ++r)
    for (int c = 0; c < cloud.columns(); ++c)
    {
      if (!cloud.valid(c, r)) continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      if (up.dot(p) > 0.3 - 1.4) points.push_back(p);  // not the floor's
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
  const Eigen::Matrix3d R_optical = T_sensor_optical().getRotationMatrix().asEigen().transpose();
  const Eigen::Vector3d up = R_optical * frame.up_sensor();
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
    EXPECT_NEAR(top->signedDistance(R_optical * R * middle_world), 0, 0.003) << error.transpose();
  }
}

TEST(HorizontalTop, OfANarrowOneTakesUpFromThePose)
{
  const SyntheticFrame frame = frameWithTable({0.06, 1.6});
  const Eigen::Vector3d up =
      T_sensor_optical().getRotationMatrix().asEigen().transpose() * frame.up_sensor();
  const auto top = topOf(frame, {1e-9, 0, 0});
  ASSERT_TRUE(top);
  EXPECT_LT(angle_deg(top->n, up), 0.5);
}
