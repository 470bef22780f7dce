#include <gtest/gtest.h>

#include <cmath>

#include "ObjectMapFixture.h"
#include "quadmap/geometry/Overlap.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(CQuadricObjectMap, WreckedCuboidsAndClutterLeaveNoConfirmedGhosts)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(7);
  camera.disturbances.wreckProbability = 0.15;
  camera.disturbances.missProbability = 0.2;
  const std::vector<TrueObject> world = {
      cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4),
      cuboid("chair", {0.9, -0.5, 0.45}, {0.45, 0.45, 0.9}, 0)};
  for (int i = 0; i < 60; ++i)
  {
    const Eigen::Vector3d eye(2.5 * std::cos(0.1 * i), 2.5 * std::sin(0.1 * i), 1.4);
    const auto T = SyntheticCamera::lookAt(eye, {0.3, -0.2, 0.4});
    auto seen = world;
    if (i % 3 == 0)  // a false alarm somewhere else each time
      seen.push_back(cuboid(
          "vase", {1.2 * camera.uniform() - 0.6, 1.2 * camera.uniform() - 0.6, 0.9},
          {0.15, 0.15, 0.3}, 0));
    map.insertObservation(camera.observe(T, seen), camera.disturbed(T));
  }
  map.consolidate();
  expectMapOf(map, world, 0.04);
}

TEST(CQuadricObjectMap, WhatIsNotSeenAgainIsNotReported)
{
  const std::vector<TrueObject> ghost = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  CQuadricObjectMap map;
  SyntheticCamera camera(8);
  walkAround(map, camera, ghost, 4);
  EXPECT_EQ(map.confirmedObjects().size(), 1u);
  walkAround(map, camera, {}, 30);
  EXPECT_TRUE(map.confirmedObjects().empty());
  EXPECT_EQ(map.objects().begin()->second.missCount, 30u);
}

TEST(CQuadricObjectMap, ASmallThingThatWasTakenAwayIsGoneWhereItWouldBeAsLargeAsItWas)
{
  // 21 px in the image, fewer than a detector is trusted to find of what it never saw.
  const std::vector<TrueObject> cup = {cuboid("cup", {0, 0, 0.8}, {0.1, 0.1, 0.1}, 0)};
  struct
  {
    double range, focal;
    bool isGone;
  } const after[] = {
      {2.4, 525,  true},
      {3.4, 525, false},
      {2.4, 262, false},
      {1.2, 262,  true}
  };
  for (const auto& look : after)
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(8);
    walkAround(map, camera, cup, 30, {0, 0, 0.8}, 2.5);
    ASSERT_EQ(map.confirmedObjects().size(), 1u);
    camera.camera.fx = camera.camera.fy = look.focal;  // another camera of the rig
    walkAround(map, camera, {}, 60, {0, 0, 0.8}, look.range);
    EXPECT_EQ(map.confirmedObjects().empty(), look.isGone) << look.range << ", " << look.focal;
  }
}

TEST(CQuadricObjectMap, OneImageThatShowsNothingDoesNotMakeThingsMissing)
{
  const std::vector<TrueObject> chairs = {
      cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0),
      cuboid("chair", {0.9, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  for (const int blank : {1, 10})
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(8);
    walkAround(map, camera, chairs, 20);
    EXPECT_EQ(map.revisits().found + map.revisits().missed, 0u) << "nobody came back";
    camera.wait(600);
    walkAround(map, camera, {}, blank);
    EXPECT_EQ(map.revisits().missed, blank == 1 ? 0u : 2u);
    EXPECT_EQ(map.revisits().found, blank == 1 ? 2u : 0u);
  }
}

TEST(CQuadricObjectMap, WhatIsFoundInHalfOfTheImagesFromOnePlaceIsThere)
{
  const std::vector<TrueObject> chair = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  CQuadricObjectMap map;
  SyntheticCamera camera(8);
  walkAround(map, camera, chair, 6);
  ASSERT_EQ(map.confirmedObjects().size(), 1u);
  camera.disturbances.missProbability = 0.5;
  const auto T = poseAround(0, 6);
  for (int i = 0; i < 400; ++i) map.insertObservation(camera.observe(T, chair), T);
  ASSERT_EQ(map.confirmedObjects().size(), 1u);
  EXPECT_GT(map.confirmedObjects()[0]->missCount, 150u);
}

TEST(CQuadricObjectMap, SteadyFalseAlarmsFromOnePlaceAreNotReported)
{
  // Things that the detector takes for chairs, of other sizes than chairs.
  const std::vector<TrueObject> all = {
      cuboid("chair", {0, 0, 0.65}, {0.30, 0.80, 1.3}, 0),
      cuboid("chair", {0, 1.2, 0.65}, {0.30, 0.80, 1.3}, 0),
      cuboid("chair", {0, -1.2, 0.65}, {0.30, 0.80, 1.3}, 0)};
  for (const std::size_t count : {1, 2, 3})
  {
    const std::vector<TrueObject> ghosts(all.begin(), all.begin() + static_cast<long>(count));
    CQuadricObjectMap map;
    SyntheticCamera camera(8);
    const auto T = poseAround(0, 6);
    for (int i = 0; i < 100; ++i)
    {
      map.insertObservation(camera.observe(T, ghosts), T);
      EXPECT_TRUE(map.confirmedObjects().empty()) << count << " after " << i;
    }
    EXPECT_EQ(map.objects().size(), count);
  }
}

TEST(CQuadricObjectMap, WhatHasTheUsualSizesIsReportedFromOnePlaceButNotFromOneImage)
{
  const std::vector<TrueObject> chair = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  CQuadricObjectMap map;
  SyntheticCamera camera(8);
  const auto T = poseAround(0, 6);
  map.insertObservation(camera.observe(T, chair), T);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_TRUE(map.confirmedObjects().empty());
  for (int i = 0; i < 4; ++i) map.insertObservation(camera.observe(T, chair), T);
  EXPECT_EQ(map.confirmedObjects().size(), 1u);
}

TEST(CQuadricObjectMap, AnotherLabelAndOtherSizesAreWeighedAnew)
{
  CQuadricObjectMap map;
  const auto sizesOf = [&](const std::string& label) {
    return Ellipsoid({0, 0, 0.5, 0, 0, 0}, map.labels().properties(label).typicalSize / 2);
  };
  MapObject object;
  object.object = sizesOf("chair");
  object.covariance *= 1e-6;
  object.labelCounts = {
      {"chair", 9}
  };
  object.completeCount = 9;
  object.existenceLogOdds = 6;
  const ObjectId id = map.addObject(object);
  EXPECT_GT(map.find(id)->logOdds(), 7);
  map.relabel(id, "cup");
  EXPECT_LT(map.find(id)->logOdds(), 5) << "no cup is as large as a chair";
  map.place(id, sizesOf("cup"));
  EXPECT_GT(map.find(id)->logOdds(), 7);
}

TEST(CQuadricObjectMap, AMissOfWhatIsAlwaysFoundSaysMore)
{
  const std::vector<TrueObject> chair = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  const auto lostByMisses = [&](double missProbability)
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(8);
    camera.disturbances.missProbability = missProbability;
    walkAround(map, camera, chair, 40);
    const double before = map.objects().begin()->second.existenceLogOdds;
    walkAround(map, camera, {}, 4, {0, 0, 0.5}, 3.5);
    return before - map.objects().begin()->second.existenceLogOdds;
  };
  EXPECT_GT(lostByMisses(0), 2 * lostByMisses(0.6));
}

TEST(CQuadricObjectMap, BoxesThatCannotBeUsedAreNoMisses)
{
  const std::vector<TrueObject> world = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  const auto T = SyntheticCamera::lookAt({2.5, 0, 1.4}, {0, 0, 0.5});
  struct Case
  {
    const char* what;
    std::string label;
    double shift;  // of the box [px]
    unsigned misses;
  };
  for (const Case& c : {
           Case{"a rejected box of its own", "chair",   0,  0u},
           {     "a label taken for it", "couch",   0,  0u},
           {         "some other thing",   "cup",   0, 10u},
           { "a rejected box elsewhere", "chair", 250, 10u}
  })
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(9);
    walkAround(map, camera, world, 6);
    for (int i = 0; i < 10; ++i)
    {
      auto obs = camera.observe(T, world);
      ASSERT_EQ(obs.objects.size(), 1u);
      auto& box = obs.objects[0];
      box.label = c.label;
      box.box.x1 += c.shift;
      box.box.x2 += c.shift;
      box.measurement = {};
      box.measurement.kind = MeasurementKind::Rejected;
      map.insertObservation(obs, T);
    }
    EXPECT_EQ(map.objects().begin()->second.missCount, c.misses) << c.what;
  }
}

TEST(CQuadricObjectMap, HiddenObjectsAreNotMissed)
{
  const std::vector<TrueObject> world = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  const auto T = SyntheticCamera::lookAt({2.5, 0, 1.4}, {0, 0, 0.5});
  struct Case
  {
    const char* what;
    float depth;
    unsigned misses;
  };
  for (const Case& c : {
           Case{"a wall in front", 1.0f,  0u},
           {      "free view", 8.0f, 10u},
           {       "no depth",  0.f,  0u}
  })
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(9);
    walkAround(map, camera, world, 6);
    for (int i = 0; i < 10; ++i)
    {
      auto obs = camera.observe(T, {});
      std::fill(obs.coarseDepth.depth.begin(), obs.coarseDepth.depth.end(), c.depth);
      map.insertObservation(obs, T);
    }
    EXPECT_EQ(map.objects().begin()->second.missCount, c.misses) << c.what;
  }
}

/** The coarse depth has two or three cells for a cup; the map knows what stands before it. */
TEST(CQuadricObjectMap, WhatIsBehindAThingOfTheMapIsNotMissed)
{
  const auto cup = cuboid("cup", {0, 0, 0.85}, {0.1, 0.1, 0.1}, 0);
  const auto vase = cuboid("vase", {0.3, 0, 0.95}, {0.2, 0.2, 0.3}, 0);
  const auto missesFrom = [&](const Eigen::Vector3d& eye)
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(9);
    walkAround(map, camera, {cup, vase}, 12);
    EXPECT_EQ(map.confirmedObjects().size(), 2u);
    const auto T = SyntheticCamera::lookAt(eye, {0, 0, 0.8});
    for (int i = 0; i < 10; ++i) map.insertObservation(camera.observe(T, {vase}), T);
    for (const auto& [id, object] : map.objects())
      if (object.label() == "cup") return object.missCount;
    return 1000u;
  };
  EXPECT_EQ(missesFrom({2.4, 0, 1.2}), 0u) << "behind the vase";
  EXPECT_EQ(missesFrom({0, 2.4, 1.2}), 10u) << "beside it";
}

/** A detector finds chairs behind tables, too: that it found none there counts as well, unless
 * hardly anything of one would show. */
TEST(CQuadricObjectMap, WhatIsHiddenInPartIsMissed)
{
  const std::vector<TrueObject> world = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.45, 0.9}, 0)};
  const auto T = SyntheticCamera::lookAt({2.5, 0, 1.4}, {0, 0, 0.5});
  const auto missesBehind = [&](unsigned firstHiddenRow)
  {
    CQuadricObjectMap map;
    SyntheticCamera camera(9);
    walkAround(map, camera, world, 6);
    for (int i = 0; i < 10; ++i)
    {
      auto obs = camera.observe(T, {});
      CoarseDepth& coarse = obs.coarseDepth;
      for (unsigned cell = 0; cell < coarse.rows * coarse.columns; ++cell)
        coarse.depth[cell] = cell / coarse.columns < firstHiddenRow ? 8.0f : 1.0f;
      map.insertObservation(obs, T);
    }
    return map.objects().begin()->second.missCount;
  };
  EXPECT_EQ(missesBehind(13), 10u) << "about its lower 40 % are hidden";
  EXPECT_EQ(missesBehind(10), 0u) << "about its lower 70 % are hidden";
}

TEST(CQuadricObjectMap, PartialMeasurementsStartAnObjectOnlyWithParallax)
{
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.6, 0.45, 0.6}, 0.4)};
  SyntheticCamera camera(10);
  camera.disturbances.partialProbability = 1;
  CQuadricObjectMap still;
  const auto T = SyntheticCamera::lookAt({2.5, 0, 1.2}, {0, 0, 0.3});
  for (int i = 0; i < 20; ++i) still.insertObservation(camera.observe(T, world), T);
  EXPECT_TRUE(still.isEmpty()) << "one direction does not fix the distance";

  CQuadricObjectMap moving;
  walkAround(moving, camera, world, 24, {0, 0, 0.3});
  moving.consolidate();
  expectMapOf(moving, world, 0.08);
  EXPECT_EQ(moving.objects().begin()->second.completeCount, 0u);
}

TEST(CQuadricObjectMap, TwoBoxesOfOneImageAreNotTwoViews)
{
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.6, 0.45, 0.6}, 0.4)};
  SyntheticCamera camera(10);
  camera.disturbances.partialProbability = 1;
  CQuadricObjectMap map;
  ASSERT_EQ(map.insertionOptions.waiting.minViews, 3);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(map.isEmpty()) << i << " images";
    const auto T = poseAround(i, 12, {0, 0, 0.3});
    auto obs = camera.observe(T, world);
    obs.objects.push_back(obs.objects.at(0));
    obs.objects[1].box.x1 += 0.6 * (obs.objects[1].box.x2 - obs.objects[1].box.x1);
    map.insertObservation(obs, T);
  }
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects().begin()->second.observations(), 3u);
}
