#include "quadmap/maps/JointSightings.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"
#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(JointSightings, CountsBoxesInTheSameImage)
{
  JointSightings together;
  together.add({1, 2, 3});
  together.add({2, 3});
  together.add({4});
  EXPECT_EQ(together.pairs(1, 2), 1u);
  EXPECT_EQ(together.pairs(3, 2), 2u);
  EXPECT_EQ(together.pairs(1, 4), 0u);
}

TEST(JointSightings, TellTwoThingsFromOneThatHasTwoBoxesNowAndThen)
{
  const auto seen = [](ObjectId id, unsigned images)
  {
    MapObject object;
    object.id = id;
    object.completeCount = images;
    return object;
  };
  JointSightings together;
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_FALSE(together.showTwoThings(seen(1, 80), seen(2, 3), 0.25)) << i << " are chance";
    together.add({1, 2});
  }
  EXPECT_FALSE(together.showTwoThings(seen(1, 80), seen(2, 3), 0.25)) << "3 are chance";
  together.add({1, 2});
  EXPECT_TRUE(together.showTwoThings(seen(1, 80), seen(2, 15), 0.25)) << "4 of 15";
  EXPECT_FALSE(together.showTwoThings(seen(1, 80), seen(2, 16), 0.25));
  together.merge(1, 2);
  EXPECT_FALSE(together.showTwoThings(seen(1, 4), seen(3, 1), 0.25)) << "no image shows both";
  together.add({1, 3});
  EXPECT_TRUE(together.showTwoThings(seen(1, 19), seen(3, 1), 0.25)) << "the fifth of 19";
  EXPECT_FALSE(together.showTwoThings(seen(1, 20), seen(3, 1), 0.25));
}

TEST(JointSightings, FollowWhatIsMergedAndForgetWhatIsRemoved)
{
  JointSightings together;
  together.add({1, 2, 3});
  together.add({2, 3});
  together.merge(1, 3);
  EXPECT_EQ(together.pairs(1, 2), 3u);
  EXPECT_EQ(together.pairs(2, 3), 0u);
  EXPECT_EQ(together.pairs(1, 1), 0u);
  together.remove(2);
  EXPECT_EQ(together.pairs(1, 2), 0u);
}

namespace
{
/** A vase before the foot of a lamp, within the cuboid of its shade. */
std::vector<TrueObject> lampAndVase()
{
  const std::vector<TrueObject> world = {
      cuboid("lamp", {0, 0, 0.75}, {0.3, 0.3, 0.5}, 0),
      cuboid("vase", {-0.07, 0.05, 0.66}, {0.12, 0.12, 0.32}, 0)};
  EXPECT_GT(
      cuboidIntersectionVolume(world[0].object, world[1].object),
      0.9 * world[1].object.cuboidVolume());
  return world;
}

/** A detector that takes them for each other. */
void confuseLampsWithVases(CQuadricObjectMap& map)
{
  map.insertionOptions.merging.minLabelAgreement = 0;
}
}  // namespace

TEST(JointSightings, TwoThingsThatShareACuboidStayTwo)
{
  for (const bool useThem : {true, false})
  {
    CQuadricObjectMap map;
    confuseLampsWithVases(map);
    if (!useThem) map.insertionOptions.merging.maxTogether = 1;
    SyntheticCamera camera(4);
    walkAround(map, camera, lampAndVase(), 30, {0, 0, 0.7});
    map.consolidate();
    EXPECT_EQ(map.confirmedObjects().size(), useThem ? 2u : 1u) << map.asString();
    if (!useThem) continue;
    expectMapOf(map, lampAndVase(), 0.05);

    // A map of them, too: no image of the next run has shown them yet.
    TemporaryFolder folder;
    map.saveToFile(folder.path("both.quadmap"));
    CQuadricObjectMap later;
    later.loadFromFile(folder.path("both.quadmap"));
    confuseLampsWithVases(later);
    walkAround(later, camera, lampAndVase(), 1, {0, 0, 0.7});
    expectMapOf(later, lampAndVase(), 0.05);
  }
}

TEST(JointSightings, ASecondBoxNowAndThenIsNoSecondThing)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(5);
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  const std::vector<TrueObject> twice = {
      world[0], cuboid("suitcase", {0.06, 0.03, 0.28}, {0.55, 0.36, 0.56}, 0.4)};
  for (int i = 0; i < 30; ++i)
  {
    const auto T = poseAround(i, 30);
    auto boxes = camera.observe(T, i % 6 == 3 ? twice : world);
    map.insertObservation(boxes, T);
  }
  map.consolidate();
  EXPECT_EQ(map.objects().size(), 1u) << map.asString();
}

TEST(JointSightings, SecondBoxesInAFewImagesInARowAreNoSecondThing)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(6);
  const TrueObject suitcase = cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4);
  const TrueObject again = cuboid("suitcase", {0.06, 0.03, 0.28}, {0.55, 0.36, 0.56}, 0.4);
  for (int i = 0; i < 40; ++i)
  {
    const auto T = poseAround(i, 40);
    const bool twice = i == 1 || i == 3 || i == 5;
    map.insertObservation(
        camera.observe(T, twice ? std::vector{suitcase, again} : std::vector{suitcase}), T);
  }
  map.consolidate();
  EXPECT_EQ(map.confirmedObjects().size(), 1u) << map.asString();
}
