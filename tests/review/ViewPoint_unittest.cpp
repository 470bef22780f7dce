#include "quadmap/review/ViewPoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
/** Position in the picture, origin in its middle, the edges at +-1. Independent of ViewPoint's
 * axes: by the look-at construction of OpenGL's textbooks. */
Eigen::Vector2d inPicture(const ViewPoint& view, double aspect, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d eye =
      view.target + view.distance * Eigen::Vector3d(
                                        std::cos(view.elevation) * std::cos(view.azimuth),
                                        std::cos(view.elevation) * std::sin(view.azimuth),
                                        std::sin(view.elevation));
  const Eigen::Vector3d forward = (view.target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const Eigen::Vector3d d = p - eye;
  const double depth = d.dot(forward), t = std::tan(0.5 * view.verticalFov);
  EXPECT_GT(depth, 0);
  return {d.dot(right) / (depth * t * aspect), d.dot(up) / (depth * t)};
}

std::vector<Eigen::Vector3d> randomPoints(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 50; ++i)
    points.emplace_back(3 * normal(random) + 2, normal(random) - 5, 0.5 * normal(random));
  return points;
}
}  // namespace

TEST(ViewPoint, FramesAllPointsTightly)
{
  constexpr double kAspect = 1.6, kMargin = 0.1;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const auto points = randomPoints(seed);
    ViewPoint view;
    view.azimuth = 0.4 * seed;
    view.elevation = 0.07 * seed;
    view = framed(view, points, kAspect, kMargin);
    Eigen::Vector2d farthest(0, 0);
    for (const auto& p : points)
      farthest = farthest.cwiseMax(inPicture(view, kAspect, p).cwiseAbs());
    EXPECT_LT(farthest.maxCoeff(), 1 - 2 * kMargin + 1e-9) << seed;
    EXPECT_NEAR(farthest.maxCoeff(), 1 - 2 * kMargin, 1e-9) << "one edge is touched; seed " << seed;
  }
}

TEST(ViewPoint, FramesAPointAndNothing)
{
  ViewPoint view;
  const ViewPoint same = framed(view, {}, 1.5, 0.1);
  EXPECT_EQ(same.target, view.target);
  EXPECT_EQ(same.distance, view.distance);
  const Eigen::Vector3d p(1, 2, 3);
  const ViewPoint one = framed(view, {p}, 1.5, 0.1);
  EXPECT_GT(one.distance, 0.1);
  EXPECT_LT((one.target - p).norm(), 1e-9);
}

TEST(ViewPoint, AxesAreRightUpAndTowardsTheEye)
{
  ViewPoint view;
  view.azimuth = -M_PI / 2;  // the eye is south, x to the right, y into the picture
  view.elevation = 0;
  EXPECT_LT((view.axes().col(0) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((view.axes().col(1) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((view.axes().col(2) + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}
