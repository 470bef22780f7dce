#include "quadmap/review/RenderCamera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
/** Position in the picture, whose origin is its middle and whose edges are at +-1. It does not use
 * RenderCamera's axes but the look-at construction of OpenGL's textbooks. */
Eigen::Vector2d inPicture(const RenderCamera& camera, double aspect, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d eye =
      camera.target + camera.distance * Eigen::Vector3d(
                                            std::cos(camera.elevation) * std::cos(camera.azimuth),
                                            std::cos(camera.elevation) * std::sin(camera.azimuth),
                                            std::sin(camera.elevation));
  const Eigen::Vector3d forward = (camera.target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const Eigen::Vector3d d = p - eye;
  const double depth = d.dot(forward), t = std::tan(0.5 * camera.verticalFov);
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

TEST(RenderCamera, FramesAllPointsTightly)
{
  constexpr double kAspect = 1.6, kMargin = 0.1;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const auto points = randomPoints(seed);
    RenderCamera camera;
    camera.azimuth = 0.4 * seed;
    camera.elevation = 0.07 * seed;
    camera = framed(camera, points, kAspect, kMargin);
    Eigen::Vector2d farthest(0, 0);
    for (const auto& p : points)
      farthest = farthest.cwiseMax(inPicture(camera, kAspect, p).cwiseAbs());
    EXPECT_LT(farthest.maxCoeff(), 1 - 2 * kMargin + 1e-9) << seed;
    EXPECT_NEAR(farthest.maxCoeff(), 1 - 2 * kMargin, 1e-9) << "one edge is touched; seed " << seed;
  }
}

TEST(RenderCamera, FramesAPointAndNothing)
{
  RenderCamera camera;
  const RenderCamera same = framed(camera, {}, 1.5, 0.1);
  EXPECT_EQ(same.target, camera.target);
  EXPECT_EQ(same.distance, camera.distance);
  const Eigen::Vector3d p(1, 2, 3);
  const RenderCamera one = framed(camera, {p}, 1.5, 0.1);
  EXPECT_GT(one.distance, 0.1);
  EXPECT_LT((one.target - p).norm(), 1e-9);
}

TEST(RenderCamera, AxesAreRightUpAndTowardsTheEye)
{
  RenderCamera camera;
  camera.azimuth = -M_PI / 2;  // the eye is in the south: x points right and y into the picture
  camera.elevation = 0;
  EXPECT_LT((camera.axes().col(0) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((camera.axes().col(1) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((camera.axes().col(2) + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}
