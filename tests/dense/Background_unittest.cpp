#include "Background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace quadmap;

namespace
{
constexpr double kClearance = 0.004;  // [m]

/** A floor of one point per 5 mm, which a box of so many metres hides, and the points of its
 * sides. */
struct BoxOnFloor
{
  explicit BoxOnFloor(double boxHeight)
  {
    constexpr double kStep = 0.005, kHalf = 0.2, kFloor = 0.4;
    for (double x = -kFloor; x < kFloor; x += kStep)
      for (double y = -kFloor; y < kFloor; y += kStep)
        if (std::max(std::abs(x), std::abs(y)) > kHalf)
          near.push_back({
              {x, y, 0},
              Eigen::Vector3d::UnitZ(), 10, 0.1
          });
    for (double along = -kHalf; along < kHalf; along += kStep)
      for (double z = kStep; z < boxHeight; z += kStep)
        for (const Eigen::Vector3d& p : {
                 Eigen::Vector3d{ along,  kHalf, z},
                 { along, -kHalf, z},
                 { kHalf,  along, z},
                 {-kHalf,  along, z}
        })
          candidates.push_back({p, p.normalized(), 5, 0.9});
    near.insert(near.end(), candidates.begin(), candidates.end());
  }
  Background background() const
  {
    Background made(kClearance);
    made.addSupport({Eigen::Vector3d::UnitZ(), 0, 0.001}, near, candidates);
    return made;
  }

  std::vector<NearPoint> near, candidates;
};
}  // namespace

TEST(Background, HasWhatLiesLowWhereTheSupportIsSeen)
{
  BoxOnFloor room(0.3);
  const Eigen::Vector3d noise(0.25, 0.1, 0.012), under(0.1, 0.1, 0.012), above(0.25, 0.1, 0.05);
  room.near.push_back({noise, Eigen::Vector3d::UnitZ(), 1, 0.9});
  const Background background = room.background();
  EXPECT_TRUE(background.contains({0.3, 0.3, 0.003})) << "the floor itself";
  EXPECT_TRUE(background.contains(noise)) << "the floor is seen below it";
  EXPECT_FALSE(background.contains(under)) << "the box hides the floor there";
  EXPECT_FALSE(background.contains(above)) << "higher than noise";
}

TEST(Background, LeavesFlatThingsTheirSides)
{
  const BoxOnFloor room(0.03);
  const Background background = room.background();
  for (const NearPoint& point : room.candidates)
    EXPECT_EQ(background.contains(point.position), point.position.z() <= kClearance);
}

TEST(Background, OfAThingThatHidesItsSupportIsOnlyThePlane)
{
  BoxOnFloor room(0.3);
  // A foot as wide as the floor that is looked at, 2 cm high: no floor is seen below it.
  const Eigen::Vector3d foot(0.25, 0.1, 0.02);
  room.near.erase(
      std::remove_if(
          room.near.begin(), room.near.end(),
          [](const NearPoint& point) { return point.position.z() == 0; }),
      room.near.end());
  room.near.push_back({foot, Eigen::Vector3d::UnitZ(), 5, 0.9});
  EXPECT_FALSE(room.background().contains(foot));
}
