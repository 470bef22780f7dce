#include "quadmap/estimation/Visibility.h"

#include <gtest/gtest.h>

#include <random>

using namespace quadmap;

namespace
{
Ellipsoid cuboidAt(const Eigen::Vector3d& center, const Eigen::Vector3d& size, double yaw = 0)
{
  return {
      {center.x(), center.y(), center.z(), yaw, 0, 0},
      size / 2
  };
}

/** By steps of the way: is it in the cuboid somewhere, and outside in the end? */
bool isHiddenBySteps(
    const Eigen::Vector3d& camera, const Eigen::Vector3d& point, const Ellipsoid& cuboid)
{
  const auto isInside = [&](const Eigen::Vector3d& p)
  {
    mrpt::math::TPoint3D local;
    cuboid.pose().inverseComposePoint({p.x(), p.y(), p.z()}, local);
    return std::abs(local.x) < cuboid.semiAxes().x() && std::abs(local.y) < cuboid.semiAxes().y() &&
           std::abs(local.z) < cuboid.semiAxes().z();
  };
  constexpr int kSteps = 4000;
  bool wasInside = false;
  for (int i = 0; i <= kSteps; ++i)
    wasInside = wasInside || isInside(camera + (point - camera) * i / kSteps);
  return wasInside && !isInside(point);
}
}  // namespace

TEST(Visibility, AThingHidesWhatIsWhollyBehindIt)
{
  const Ellipsoid cup = cuboidAt({0, 0, 0.8}, {0.1, 0.1, 0.1});
  const Eigen::Vector3d camera(2, 0, 1);
  const auto isHiddenBy = [&](const Ellipsoid& thing) {
    return isBehind(cup, {cup, thing}, camera, {});
  };
  EXPECT_FALSE(isBehind(cup, {cup}, camera, {})) << "by itself";
  EXPECT_TRUE(isHiddenBy(cuboidAt({0.25, 0, 0.9}, {0.18, 0.18, 0.3}))) << "a vase before it";
  EXPECT_FALSE(isHiddenBy(cuboidAt({-0.25, 0, 0.9}, {0.18, 0.18, 0.3}))) << "behind it";
  EXPECT_FALSE(isHiddenBy(cuboidAt({0.25, 0.2, 0.9}, {0.18, 0.18, 0.3}))) << "beside it";
  EXPECT_FALSE(isHiddenBy(cuboidAt({0, 0, 0.375}, {1.5, 0.9, 0.75}))) << "the table it stands on";
  EXPECT_FALSE(isHiddenBy(cuboidAt({0.25, 0, 0.9}, {0.6, 0.6, 0.6}))) << "it stands in it";
  EXPECT_FALSE(isHiddenBy(cuboidAt({2.5, 0, 1}, {0.5, 0.5, 2}))) << "behind the camera";
}

TEST(Visibility, ThingsHideTogether)
{
  const Ellipsoid box = cuboidAt({0, 0, 0.5}, {0.4, 0.8, 0.4});
  const Ellipsoid left = cuboidAt({1, 0.25, 0.5}, {0.1, 0.3, 1}),
                  right = cuboidAt({1, -0.25, 0.5}, {0.1, 0.3, 1});
  EXPECT_FALSE(isBehind(box, {left}, {3, 0, 0.5}, {}));
  EXPECT_FALSE(isBehind(box, {right}, {3, 0, 0.5}, {}));
  ExistenceOptions options;
  options.maxHiddenShare = 0.25;
  EXPECT_TRUE(isBehind(box, {left, right}, {3, 0, 0.5}, options)) << "both ends, two of seven";
  EXPECT_FALSE(isBehind(box, {left}, {3, 0, 0.5}, options));
}

TEST(Visibility, ASmallThingIsHiddenAsStepsOnTheWayToItTell)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> in(-1, 1);
  unsigned hidden = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Ellipsoid thing = cuboidAt(
        {in(generator), in(generator), in(generator)},
        Eigen::Vector3d(1.2 + in(generator), 1.2 + in(generator), 1.2 + in(generator)),
        3 * in(generator));
    const Eigen::Vector3d camera(3 + in(generator), 2 * in(generator), 2 * in(generator)),
        point(-0.5 + in(generator), in(generator), in(generator));
    const bool isHidden = isHiddenBySteps(camera, point, thing);
    EXPECT_EQ(
        isBehind(cuboidAt(point, Eigen::Vector3d::Constant(1e-5)), {thing}, camera, {}), isHidden)
        << i;
    hidden += isHidden;
  }
  EXPECT_GT(hidden, 60u);
  EXPECT_LT(hidden, 240u);
}
