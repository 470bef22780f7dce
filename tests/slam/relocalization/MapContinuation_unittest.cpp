#include "quadmap/slam/MapContinuation.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "../../maps/ObjectMapFixture.h"
#include "../../obs/TemporaryFolder.h"
#include "backend/GivenPoses.h"
#include "quadmap/slam/SlamResult.h"
#include "relocalization/ContinueMap.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
using World = std::vector<TrueObject>;

World furniture()
{
  return {
      cuboid("dining table", {0, 0, 0.375}, {1.4, 0.9, 0.75}, 0.1),
      cuboid("chair", {1.15, 0.1, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("chair", {-0.35, 0.9, 0.45}, {0.45, 0.45, 0.9}, 0.4),
      cuboid("refrigerator", {-1.2, -1.0, 0.9}, {0.6, 0.65, 1.8}, 0.2),
      cuboid("suitcase", {0.9, -1.1, 0.3}, {0.7, 0.4, 0.6}, 0.7),
      cuboid("tv", {-1.3, 0.6, 0.9}, {0.8, 0.15, 0.5}, 1.2)};
}

/** A finished run: what it saw, and its map, in a frame of its own. */
struct Session
{
  SlamResult result;
  std::vector<CObservationObjects::Ptr> boxes;

  Session(const World& world, const CPose3D& T_map_local, unsigned seed, int frames = 48)
  {
    SyntheticCamera camera(seed);
    for (int i = 0; i < frames; ++i)
    {
      const double angle = 2 * M_PI * (i + 0.3) / frames;
      const Eigen::Vector3d eye(2.6 * std::cos(angle), 2.6 * std::sin(angle), 1.5);
      const auto T_map_sensor = SyntheticCamera::lookAt(eye, {0, 0, 0.5});
      boxes.push_back(CObservationObjects::Create(camera.observe(T_map_sensor, world)));
      Keyframe keyframe;
      keyframe.T_map_robot = -T_map_local + camera.disturbed(T_map_sensor);
      keyframe.T_odom_robot = keyframe.T_map_robot;
      result.keyframes.push_back(keyframe);
      BackEnd::insertIntoMap(
          *boxes.back(), static_cast<std::size_t>(i), keyframe.T_map_robot, result);
    }
    result.map.consolidate();
  }

  void continueIn(const CQuadricObjectMap& given)
  {
    GivenPoses backEnd;
    continueIn(given, backEnd);
  }

  void continueIn(const CQuadricObjectMap& given, BackEnd& backEnd)
  {
    continueMap(
        given, backEnd, [this](std::size_t k) { return boxes[k]; }, {}, result);
  }
};

const CPose3D kElsewhere(2.5, -1.0, 0.1, mrpt::DEG2RAD(130.0), 0, 0);

/** Spoils the run, and then notices or does not. */
struct LosingBackEnd : GivenPoses
{
  bool asks = false;

  void correctWith(const KnownObjects& known, const BoxesOf&, SlamResult& result) override
  {
    for (auto& keyframe : result.keyframes) keyframe.T_map_robot = CPose3D(50, 0, 0, 0, 0, 0);
    result.map.clear();
    result.decisions.clear();
    if (asks) known(result.map);
  }
};

ObjectId idAt(const CQuadricObjectMap& map, const TrueObject& truth)
{
  const MapObject* found = map.nearest(pointOf(truth.object.center()), truth.label);
  return found && (found->object.center() - truth.object.center()).norm() < 0.1 ? found->id : 0;
}
}  // namespace

TEST(MapContinuation, UnchangedRoomKeepsItsObjects)
{
  const World world = furniture();
  const CQuadricObjectMap given = Session(world, {}, 1).result.map;
  ASSERT_NO_FATAL_FAILURE(expectMapOf(given, world, 0.06));
  Session run(world, kElsewhere, 2);
  run.continueIn(given);

  expectMapOf(run.result.map, world, 0.06);
  ASSERT_TRUE(run.result.continuation);
  const MapContinuation& changes = *run.result.continuation;
  EXPECT_EQ(changes.knownObjects, world.size());
  EXPECT_EQ(changes.match.pairs.size(), world.size());
  EXPECT_TRUE(changes.added.empty() && changes.removed.empty() && changes.moved.empty());
  for (const auto& truth : world)
  {
    const MapObject& before = *given.find(idAt(given, truth));
    ASSERT_EQ(idAt(run.result.map, truth), before.id) << truth.label;
    EXPECT_GT(run.result.map.find(before.id)->observations(), before.observations());
  }
  for (const auto& d : run.result.decisions)
    EXPECT_TRUE(!d.decision.object || given.find(*d.decision.object)) << d.keyframe;
}

TEST(MapContinuation, PosesComeIntoTheMapsFrame)
{
  const World world = furniture();
  const CQuadricObjectMap given = Session(world, {}, 3).result.map;
  const Session there(world, {}, 4);  // the same noise, in the map's frame
  Session run(world, kElsewhere, 4);
  auto& covariance = run.result.keyframes[1].covariance.emplace();
  covariance(0, 0) = covariance(3, 3) = 1;  // only along x, and of the yaw
  run.continueIn(given);
  const CPose3D& T_map_local = run.result.continuation->match.T_map_local;
  const Eigen::Vector3d x = T_map_local.getRotationMatrix().asEigen().col(0);
  const Eigen::Matrix<double, 6, 6> turned = run.result.keyframes[1].covariance.value().asEigen();
  EXPECT_LT((turned.topLeftCorner<3, 3>() - x * x.transpose()).norm(), 1e-6);
  EXPECT_NEAR(turned(3, 3), 1, 1e-6) << "yaws are only shifted";
  for (std::size_t k = 0; k < run.result.keyframes.size(); ++k)
  {
    const CPose3D error =
        run.result.keyframes[k].T_map_robot - there.result.keyframes[k].T_map_robot;
    EXPECT_LT(error.norm(), 0.08) << k;
    EXPECT_LT(std::abs(error.yaw()), mrpt::DEG2RAD(1.5)) << k;
  }
}

TEST(MapContinuation, ARunLostInItsCorrectionGoesOnWithoutIt)
{
  const World before = furniture();
  const CQuadricObjectMap given = Session(before, {}, 13).result.map;
  World now = before;
  now[4] = cuboid("suitcase", {1.4, -1.6, 0.3}, {0.7, 0.4, 0.6}, 0.7);  // its own length on
  const Session there(now, {}, 14);  // the same noise, in the map's frame
  for (const bool asks : {false, true})
  {
    Session run(now, kElsewhere, 14);
    LosingBackEnd backEnd;
    backEnd.asks = asks;
    run.continueIn(given, backEnd);
    ASSERT_NO_FATAL_FAILURE(expectMapOf(run.result.map, now, 0.08));
    const MapContinuation& changes = run.result.continuation.value();
    EXPECT_TRUE(changes.lostInCorrection);
    EXPECT_EQ(changes.match.pairs.size(), now.size() - 1);
    EXPECT_EQ(changes.moved.size(), 1u);
    EXPECT_TRUE(changes.added.empty() && changes.removed.empty());
    for (std::size_t k = 0; k < run.result.keyframes.size(); ++k)
      EXPECT_LT(
          (run.result.keyframes[k].T_map_robot - there.result.keyframes[k].T_map_robot).norm(),
          0.08)
          << k;
  }
  Session run(now, kElsewhere, 14);
  run.continueIn(given);
  EXPECT_FALSE(run.result.continuation.value().lostInCorrection);
}

TEST(MapContinuation, NoticesWhatMovedWentAndCame)
{
  const World before = furniture();
  const CQuadricObjectMap given = Session(before, {}, 5).result.map;
  World now = before;
  now[1] = cuboid("chair", {1.0, 1.1, 0.45}, {0.45, 0.45, 0.9}, 1.0);  // a metre on
  now[4] =
      cuboid("potted plant", {0.1, -1.2, 0.3}, {0.5, 0.5, 0.6}, 0);  // no suitcase, but a plant
  Session run(now, kElsewhere, 6);
  run.continueIn(given);

  expectMapOf(run.result.map, now, 0.08);
  const MapContinuation& changes = *run.result.continuation;
  ASSERT_EQ(changes.moved.size(), 1u);
  EXPECT_EQ(changes.moved[0].from, idAt(given, before[1]));
  EXPECT_EQ(changes.moved[0].to, idAt(run.result.map, now[1]));
  EXPECT_NEAR(changes.moved[0].distance, std::hypot(0.15, 1.0), 0.08);
  EXPECT_EQ(changes.removed, std::vector<ObjectId>{idAt(given, before[4])});
  EXPECT_EQ(changes.added, std::vector<ObjectId>{idAt(run.result.map, now[4])});
  for (const std::size_t same : {0, 2, 3, 5})
    EXPECT_EQ(idAt(run.result.map, now[same]), idAt(given, before[same])) << same;
}

TEST(MapContinuation, NoticesAMoveByLessThanItsOwnSize)
{
  const World before = furniture();
  World now = before;
  now[4] = cuboid("suitcase", {1.15, -1.35, 0.3}, {0.7, 0.4, 0.6}, 0.7);
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const CQuadricObjectMap given = Session(before, {}, 7 + 100 * seed).result.map;
    Session run(now, kElsewhere, 8 + 100 * seed);
    run.continueIn(given);
    ASSERT_NO_FATAL_FAILURE(expectMapOf(run.result.map, now, 0.08)) << seed;
    ASSERT_EQ(run.result.continuation->moved.size(), 1u) << seed;
    EXPECT_NEAR(run.result.continuation->moved[0].distance, 0.25 * std::sqrt(2.0), 0.08) << seed;
  }
}

TEST(MapContinuation, LabelsThatOnlyTheMapKnowsStayKnown)
{
  const World world = furniture();
  CQuadricObjectMap given = Session(world, {}, 15).result.map;
  const TemporaryFolder folder;
  given.setLabels(LabelTable::fromFile(
      folder.write("labels.ini", "[crane]\ntypicalSize = 2 2 5\n[chair]\ntypicalSize = 9 9 9\n")));
  Session run(world, kElsewhere, 16);
  const LabelTable installed = run.result.map.labels();
  run.continueIn(given);
  EXPECT_TRUE(run.result.map.labels().properties("crane").known);
  EXPECT_EQ(
      run.result.map.labels().properties("chair").typicalSize,
      installed.properties("chair").typicalSize)
      << "what the run was told of a label counts";
}

TEST(MapContinuation, WhatWasNotLookedAtStays)
{
  World world = furniture();
  World both = world;
  both.push_back(cuboid("bed", {0, 9, 0.3}, {2.0, 1.5, 0.6}, 0));
  CQuadricObjectMap given;
  SyntheticCamera camera(9);
  walkAround(given, camera, both, 48);
  walkAround(given, camera, both, 24, {0, 9, 0.3}, 3.0);
  given.consolidate();
  ASSERT_NO_FATAL_FAILURE(expectMapOf(given, both, 0.08));
  Session run(world, kElsewhere, 10);
  run.continueIn(given);
  expectMapOf(run.result.map, both, 0.08);
  EXPECT_TRUE(run.result.continuation->removed.empty());
}

TEST(MapContinuation, AnotherRoomIsRefusedAndTheRunStaysAsItWas)
{
  const CQuadricObjectMap given = Session(furniture(), {}, 11).result.map;
  const World other = {
      cuboid("bed", {0, 0, 0.3}, {2.0, 1.5, 0.6}, 0),
      cuboid("chair", {1.3, 0.9, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("couch", {-0.5, -1.4, 0.4}, {1.8, 0.9, 0.8}, 0.1)};
  Session run(other, {}, 12);
  EXPECT_THROW(run.continueIn(given), NotLocalised);
  EXPECT_FALSE(run.result.continuation);

  const Session same(other, {}, 12);
  ASSERT_EQ(run.result.map.objects().size(), same.result.map.objects().size());
  for (const auto& [id, object] : same.result.map.objects())
    EXPECT_EQ(run.result.map.find(id)->object.center(), object.object.center()) << id;
  for (std::size_t k = 0; k < same.result.keyframes.size(); ++k)
    EXPECT_EQ(run.result.keyframes[k].T_map_robot, same.result.keyframes[k].T_map_robot) << k;
}
