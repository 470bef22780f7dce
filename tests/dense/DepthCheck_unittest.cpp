#include "quadmap/dense/DepthCheck.h"

#include <gtest/gtest.h>

#include "ResultFolder.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using quadmap::testing::ResultFolder;

namespace
{
/** The check of one object of the room whose cuboid is what `change` makes of the true one. */
template <typename Change>
SelfCheckedObject checked(const Change& change)
{
  const ResultFolder result(SyntheticRoom(), 8);
  ObjectRecord record = result.record();
  record.object = change(SyntheticRoom().box);
  return checkAgainstDepth(result.path(), {record}, {}, [](double) {}).objects.at(0);
}
}  // namespace

TEST(DepthCheck, ATrueObjectExplainsAllItsPointsAndStopsAllRays)
{
  const SelfCheckedObject found = checked([](const Ellipsoid& box) { return box; });
  EXPECT_EQ(found.id, "7");
  EXPECT_EQ(found.label, "suitcase");
  EXPECT_GT(found.points, 1000u);
  EXPECT_GT(*found.onSurface, 0.999);
  EXPECT_GT(found.rays, 3000u);
  EXPECT_EQ(*found.through, 0);
}

TEST(DepthCheck, PointsLieBeyondAnObjectThatIsTooSmall)
{
  const SelfCheckedObject found =
      checked([](const Ellipsoid& box) { return Ellipsoid(box.pose(), 0.7 * box.semiAxes()); });
  EXPECT_GT(*found.beyond, 0.95);
  EXPECT_EQ(*found.inside, 0);
  EXPECT_NEAR(*found.onSurface + *found.inside + *found.beyond, 1, 1e-12);
}

TEST(DepthCheck, PointsLieInsideAnObjectThatIsTooLarge)
{
  const SelfCheckedObject found =
      checked([](const Ellipsoid& box) { return Ellipsoid(box.pose(), 1.3 * box.semiAxes()); });
  EXPECT_GT(*found.inside, 0.8);
  EXPECT_EQ(*found.beyond, 0);
}

TEST(DepthCheck, RaysGoThroughAnObjectThatIsNotThere)
{
  // Beside the cuboid, where all cameras see the floor.
  const SelfCheckedObject found =
      checked([](const Ellipsoid& box)
              { return Ellipsoid(CPose3D(1.0, 0.6, 0.3, 0, 0, 0), 0.5 * box.semiAxes()); });
  EXPECT_GT(found.rays, 1000u);
  EXPECT_GT(*found.through, 0.9);
}

TEST(DepthCheck, WhatStandsInFrontHidesAnObject)
{
  // Below the floor, which every ray meets first.
  const SelfCheckedObject found =
      checked([](const Ellipsoid& box)
              { return Ellipsoid(CPose3D(0.2, -0.1, -1.0, 0, 0, 0), 0.5 * box.semiAxes()); });
  EXPECT_EQ(found.rays, 0u);
  EXPECT_FALSE(found.through);
}
