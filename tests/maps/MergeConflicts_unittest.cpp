// What merging says of things that only one map has, or that both have elsewhere, by the images of
// both sessions.
#include <gtest/gtest.h>

#include <chrono>
#include <utility>

#include "ObjectMapFixture.h"
#include "quadmap/maps/MapMerge.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
using World = std::vector<TrueObject>;

const CPose3D kOtherSession(1.5, -0.7, 0.1, 2.1, 0, 0);  // T_own_other

/** A walk around a room: the map and the frames it was made of. */
struct Session
{
  CQuadricObjectMap map;
  std::vector<std::pair<CObservationObjects, CPose3D>> frames;

  SessionFrames replay() const
  {
    return [this](const auto& use)
    {
      for (const auto& [boxes, T_map_robot] : frames) use(boxes, T_map_robot);
    };
  }
};

/** \param T_world_map The frame of the map. \param later Start after that of other sessions [s]. */
Session sessionIn(const World& world, const CPose3D& T_world_map, unsigned seed, int later)
{
  Session session;
  SyntheticCamera camera(seed);
  constexpr int kFrames = 48;
  for (int i = 0; i < kFrames; ++i)
  {
    const CPose3D T_world_sensor = poseAround(i, kFrames, {0, 0, 0.5}, 3.2);
    CObservationObjects boxes = camera.observe(T_world_sensor, world);
    boxes.timestamp += std::chrono::seconds(later);
    const CPose3D T_map_sensor = -T_world_map + camera.disturbed(T_world_sensor);
    session.map.insertObservation(boxes, T_map_sensor);
    session.frames.emplace_back(boxes, T_map_sensor);
  }
  session.map.consolidate();
  return session;
}

World stays()
{
  return {
      cuboid("dining table", {0.1, 0.2, 0.375}, {1.4, 0.9, 0.75}, 0.1),
      cuboid("couch", {-1.6, -0.6, 0.4}, {1.9, 0.9, 0.8}, 1.4),
      cuboid("refrigerator", {1.7, 1.1, 0.9}, {0.65, 0.6, 1.8}, 0.3),
      cuboid("potted plant", {-0.4, 1.7, 0.6}, {0.5, 0.5, 1.2}, 0),
      cuboid("tv", {1.2, -1.4, 0.9}, {0.2, 0.9, 0.6}, 0.4)};
}

World staysAnd(const TrueObject& more)
{
  World world = stays();
  world.push_back(more);
  return world;
}

const TrueObject kChair = cuboid("chair", {-1.4, 0.9, 0.45}, {0.5, 0.5, 0.9}, 0.2);
const TrueObject kMovedChair = cuboid("chair", {0.2, -1.3, 0.45}, {0.5, 0.5, 0.9}, 0.8);

double distanceBetween(const TrueObject& a, const TrueObject& b)
{
  return (a.object.center() - b.object.center()).norm();
}

}  // namespace

TEST(MergeConflicts, WhatMovedFarIsWhereTheNewerMapHasIt)
{
  for (const bool otherIsNewer : {true, false})
  {
    const Session own = sessionIn(staysAnd(kChair), {}, 1, otherIsNewer ? 0 : 1000);
    const Session other =
        sessionIn(staysAnd(kMovedChair), kOtherSession, 2, otherIsNewer ? 1000 : 0);
    CQuadricObjectMap both = own.map;
    const auto merge = both.mergeMap(other.map, {}, own.replay(), other.replay());
    ASSERT_TRUE(merge);
    EXPECT_EQ(merge->otherIsNewer, otherIsNewer);
    ASSERT_EQ(merge->conflicts.size(), 1u) << both.asString();
    const auto& conflict = merge->conflicts.front();
    EXPECT_EQ(conflict.kind, MapConflict::Moved);
    EXPECT_EQ(conflict.label, "chair");
    EXPECT_EQ(conflict.origin.own, own.map.withLabel("chair").front()->id);
    EXPECT_EQ(conflict.origin.other, other.map.withLabel("chair").front()->id);
    EXPECT_NEAR(conflict.distance, distanceBetween(kChair, kMovedChair), 0.1) << "[m]";
    const auto chairs = both.withLabel("chair");
    ASSERT_EQ(chairs.size(), 1u) << both.asString();
    EXPECT_EQ(chairs.front()->id, conflict.origin.id);
    const TrueObject& there = otherIsNewer ? kMovedChair : kChair;
    EXPECT_LT((chairs.front()->object.center() - there.object.center()).norm(), 0.06) << "[m]";
  }
}

TEST(MergeConflicts, OnlyTheImagesOfTheOlderMapTellWhatIsNew)
{
  const Session own = sessionIn(stays(), {}, 1, 0);
  const Session other = sessionIn(staysAnd(kChair), kOtherSession, 2, 1000);
  CQuadricObjectMap both = own.map, blind = own.map;
  const auto merge = both.mergeMap(other.map, {}, own.replay(), other.replay());
  const auto without = blind.mergeMap(other.map, {}, {}, other.replay());
  ASSERT_TRUE(merge && without);
  ASSERT_EQ(merge->conflicts.size(), 1u);
  const auto& conflict = merge->conflicts.front();
  EXPECT_EQ(conflict.kind, MapConflict::New);
  EXPECT_EQ(conflict.label, "chair");
  EXPECT_FALSE(conflict.origin.own);
  EXPECT_EQ(conflict.origin.other, other.map.withLabel("chair").front()->id);
  ASSERT_TRUE(both.find(conflict.origin.id));
  EXPECT_LT((both.find(conflict.origin.id)->object.center() - kChair.object.center()).norm(), 0.06);
  ASSERT_EQ(without->conflicts.size(), 1u);
  EXPECT_EQ(without->conflicts.front().kind, MapConflict::OnlyOne);
  for (const CQuadricObjectMap* map : {&both, &blind}) expectMapOf(*map, staysAnd(kChair), 0.1);
}

TEST(MergeConflicts, WhatNoImageOfTheOlderMapCouldShowIsNotNew)
{
  // High above the room, which the first session looks down on.
  const TrueObject above = cuboid("suitcase", {0.0, 0.0, 4.5}, {0.3, 0.5, 0.7}, 0.2);
  const Session own = sessionIn(stays(), {}, 1, 0);
  Session other = sessionIn(stays(), kOtherSession, 2, 1000);
  MapObject found = *other.map.withLabel("tv").front();
  found.id = 0;
  found.object = above.object.transformed(-kOtherSession);
  found.labelCounts = {
      {"suitcase", 20}
  };
  other.map.addObject(found);
  CQuadricObjectMap both = own.map;
  const auto merge = both.mergeMap(other.map, {}, own.replay(), other.replay());
  ASSERT_TRUE(merge);
  for (const auto& conflict : merge->conflicts) EXPECT_NE(conflict.kind, MapConflict::New);
  EXPECT_EQ(both.withLabel("suitcase").size(), 1u);
}
