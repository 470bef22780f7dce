#include "quadmap/maps/CQuadricObjectMap.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>

#include "ObjectMapFixture.h"
#include "quadmap/geometry/Overlap.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(CQuadricObjectMap, MapsAKitchenOnceEach)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  camera.disturbances.missProbability = 0.3;
  walkAround(map, camera, kitchen(), 80, {0, 0, 0.5}, 2.8);
  map.consolidate();
  expectMapOf(map, kitchen(), 0.05);
}

TEST(CQuadricObjectMap, OrderOfConsolidationDoesNotMatter)
{
  CQuadricObjectMap map = smallMap();
  const auto before = map.toRecords();
  map.consolidate();
  const auto after = map.toRecords();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((before[i].object.center() - after[i].object.center()).norm(), 1e-3);
}

TEST(CQuadricObjectMap, TwoCupsHalfAMetreApartNeverBecomeOne)
{
  const std::vector<TrueObject> cups = {
      cuboid("cup", {-0.25, 0, 0.8}, {0.09, 0.09, 0.1}, 0),
      cuboid("cup", {0.25, 0, 0.8}, {0.09, 0.09, 0.1}, 0)};
  CQuadricObjectMap map;
  SyntheticCamera camera(2);
  // First one alone, often; the second one only afterwards.
  walkAround(map, camera, {cups[0]}, 60, {0, 0, 0.8}, 1.5);
  walkAround(map, camera, {cups[1]}, 60, {0, 0, 0.8}, 1.5);
  map.consolidate();
  ASSERT_EQ(map.objects().size(), 2u) << map.asString();
  auto object = map.objects().begin();
  for (const auto& cup : cups)
  {
    EXPECT_LT((object->second.object.center() - cup.object.center()).norm(), 0.02);
    EXPECT_EQ(object->second.observations(), 60u);
    ++object;
  }
}

TEST(CQuadricObjectMap, LabelFlipsStayOneObject)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(3);
  camera.disturbances.flipProbability = 0.4;
  camera.disturbances.flipLabel = "laptop";
  const std::vector<TrueObject> world = {cuboid("tv", {0, 0, 1.0}, {0.8, 0.12, 0.5}, 0.3)};
  walkAround(map, camera, world, 40, {0, 0, 1}, 2.0);
  map.consolidate();
  expectMapOf(map, world, 0.03);
  const auto* tv = map.confirmedObjects().at(0);
  EXPECT_EQ(tv->labelCounts.size(), 2u);
  EXPECT_EQ(tv->label(), "tv");
}

TEST(CQuadricObjectMap, WhatWasMeasuredAsAnotherKindOfThingDoesNotShapeAnObject)
{
  const std::vector<TrueObject> world = {cuboid("chair", {0, 0, 0.45}, {0.45, 0.5, 0.9}, 0.3)};
  CQuadricObjectMap map;
  map.insertionOptions.useInstanceIds = true;  // all boxes show the chair
  SyntheticCamera camera(7);
  for (int i = 0; i < 40; ++i)
  {
    const auto T_map_sensor = poseAround(i, 40);
    CObservationObjects seen = camera.observe(T_map_sensor, world);
    // Nearly every second time the detector boxes a part of it and calls that a book.
    for (auto& d : seen.objects)
    {
      d.instanceId = 1;
      auto& complete = d.measurement.complete;
      if (i % 2 == 0 || i < 5 || !complete) continue;
      d.label = "book";
      const Ellipsoid whole = complete->object_sensor;
      complete->object_sensor =
          Ellipsoid(whole.pose(), whole.semiAxes().cwiseProduct(Eigen::Vector3d(0.7, 0.7, 1)));
      for (auto& face : complete->faces) face = {FaceKind::Measured, 0.003};
    }
    map.insertObservation(seen, camera.disturbed(T_map_sensor));
  }
  map.consolidate();
  const MapObject* chair = map.nearest({0, 0, 0.45}, "chair");
  ASSERT_TRUE(chair) << map.asString();
  const Eigen::Vector3d size = 2 * chair->object.semiAxes();
  EXPECT_EQ(chair->observations(), 40u) << "they tell that it is there";
  EXPECT_GT(size.head<2>().minCoeff(), 0.44) << map.asString();
}

TEST(CQuadricObjectMap, ThingsOnAndUnderATableStayThemselves)
{
  const std::vector<TrueObject> world = {
      cuboid("dining table", {0, 0, 0.45}, {1.4, 0.9, 0.9}, 0),  // with what stands on it
      cuboid("cup", {0.3, 0.1, 0.8}, {0.09, 0.09, 0.1}, 0),
      cuboid("chair", {0.1, 0.5, 0.45}, {0.45, 0.45, 0.9}, 0)};  // pushed under
  ASSERT_GT(
      cuboidIntersectionVolume(world[0].object, world[2].object),
      0.35 * world[2].object.cuboidVolume());
  CQuadricObjectMap map;
  SyntheticCamera camera(4);
  walkAround(map, camera, world, 50);
  map.consolidate();
  expectMapOf(map, world, 0.06);
}

TEST(CQuadricObjectMap, OverlappingObjectsWithTheSameLabelMerge)
{
  CQuadricObjectMap map;
  map.insertionOptions.useInstanceIds = true;  // forces two objects at one place
  SyntheticCamera camera(5);
  const TrueObject truth = cuboid("chair", {0, 0, 0.45}, {0.5, 0.5, 0.9}, 0.2);
  for (int i = 0; i < 12; ++i)
  {
    const auto T = SyntheticCamera::lookAt(
        {2 * std::cos(0.5 * i), 2 * std::sin(0.5 * i), 1.4}, truth.object.center());
    auto obs = camera.observe(T, {truth});
    for (auto& d : obs.objects) d.instanceId = static_cast<std::uint32_t>(i % 2);
    map.insertObservation(obs, T);
  }
  EXPECT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects().begin()->second.observations(), 12u);
}

TEST(CQuadricObjectMap, InstanceIdsAreBelievedWhenAsked)
{
  // Two balls moving apart by less than any gate: only the ids tell them from one another.
  for (const bool believe : {false, true})
  {
    CQuadricObjectMap map;
    map.insertionOptions.useInstanceIds = believe;
    map.insertionOptions.merging.anyLabelIoU = 1.0;
    map.insertionOptions.merging.overlap = 1.0;
    map.insertionOptions.merging.penetration = 0;
    SyntheticCamera camera(6);
    for (int i = 0; i < 10; ++i)
    {
      const double x = i % 2 == 0 ? -0.03 : 0.03;
      const auto T = SyntheticCamera::lookAt({0, -1.5, 1.2}, {0, 0, 0.8});
      auto obs = camera.observe(T, {cuboid("cup", {x, 0, 0.8}, {0.1, 0.1, 0.1}, 0)});
      obs.objects.at(0).instanceId = static_cast<std::uint32_t>(7 + i % 2);
      map.insertObservation(obs, T);
    }
    EXPECT_EQ(map.objects().size(), believe ? 2u : 1u);
  }
}

TEST(CQuadricObjectMap, DuplicateBoxesOfOneFrameCountOnce)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(11);
  const auto T = SyntheticCamera::lookAt({2, 0, 1.2}, {0, 0, 0.8});
  auto obs = camera.observe(T, {cuboid("tv", {0, 0, 0.8}, {0.2, 0.8, 0.5}, 0)});
  obs.objects.push_back(obs.objects.at(0));
  obs.objects[1].label = "laptop";
  obs.objects[1].score = 0.1;
  map.insertObservation(obs, T);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects().begin()->second.label(), "tv");
  EXPECT_EQ(map.lastDecisions().size(), 1u);
}

TEST(CQuadricObjectMap, TellsHowBoxesWereAssigned)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(12);
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  const auto T = SyntheticCamera::lookAt({2.5, 0, 1.2}, {0, 0, 0.3});
  map.insertObservation(camera.observe(T, world), T);
  ASSERT_EQ(map.lastDecisions().size(), 1u);
  EXPECT_TRUE(map.lastDecisions()[0].startedObject);
  map.insertObservation(camera.observe(T, world), T);
  EXPECT_FALSE(map.lastDecisions()[0].startedObject);
  EXPECT_EQ(map.lastDecisions()[0].object, map.objects().begin()->first);
  EXPECT_GT(map.lastDecisions()[0].logPosterior, map.lastDecisions()[0].logPosteriorSecond);
}

TEST(CQuadricObjectMap, InsertsAtTheOriginWithoutAPose)
{
  SyntheticCamera camera(13);
  CQuadricObjectMap map;
  auto obs = camera.observe({}, {cuboid("suitcase", {2, 0, 0}, {0.4, 0.4, 0.4}, 0)});
  EXPECT_TRUE(map.insertObservation(obs));
  EXPECT_LT((map.objects().begin()->second.object.center() - Eigen::Vector3d(2, 0, 0)).norm(), 0.1);
}

TEST(CQuadricObjectMap, IgnoresWhatItCannotUse)
{
  CQuadricObjectMap map;
  EXPECT_FALSE(map.insertObservation(CObservationObjects()));
  mrpt::obs::CObservation3DRangeScan scan;
  EXPECT_FALSE(map.insertObservation(scan));
  EXPECT_TRUE(map.isEmpty());

  SyntheticCamera camera(14);
  auto weak = camera.observe({}, {cuboid("suitcase", {2, 0, 0}, {0.4, 0.4, 0.4}, 0)});
  weak.objects.at(0).score = 0.2;
  map.insertionOptions.minScore = 0.5;
  EXPECT_FALSE(map.insertObservation(weak));
  map.insertionOptions.minScore = 0;
  map.genericMapParams.enableObservationInsertion = false;
  EXPECT_FALSE(map.insertObservation(weak));
}

TEST(CQuadricObjectMap, RebuildsFromASimpleMap)
{
  SyntheticCamera camera(15);
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  mrpt::maps::CSimpleMap simple;
  for (int i = 0; i < 12; ++i)
  {
    const auto T =
        SyntheticCamera::lookAt({2 * std::cos(0.5 * i), 2 * std::sin(0.5 * i), 1.2}, {0, 0, 0.3});
    mrpt::obs::CSensoryFrame frame;
    frame.insert(std::make_shared<CObservationObjects>(camera.observe(T, world)));
    simple.insert(mrpt::poses::CPose3DPDFGaussian(T), frame);
  }
  CQuadricObjectMap map = smallMap();
  map.loadFromSimpleMap(simple);
  expectMapOf(map, world, 0.03);
}

TEST(CQuadricObjectMap, FramesWithFiveBoxesAndFiftyObjectsTakeMilliseconds)
{
  std::vector<TrueObject> world;
  for (int i = 0; i < 50; ++i)
    world.push_back(
        cuboid("suitcase", {1.1 * (i % 10), 3.0 * (i / 10), 0.3}, {0.7, 0.4, 0.6}, 0.1 * i));
  CQuadricObjectMap map;
  SyntheticCamera camera(16);
  const auto visit = [&](int i)
  {
    const auto first = world.begin() + (5 * i) % 50;
    const Eigen::Vector3d target = (first + 2)->object.center();
    const auto T =
        SyntheticCamera::lookAt(target + Eigen::Vector3d(0.3 * (i % 7), -4, 2.5), target);
    return std::pair{camera.observe(T, {first, first + 5}), T};
  };
  for (int i = 0; i < 400; ++i)
  {
    const auto [obs, T] = visit(i);
    map.insertObservation(obs, T);
  }
  EXPECT_EQ(map.objects().size(), 50u);
  const double start = mrpt::Clock::toDouble(mrpt::Clock::now());
  constexpr int kFrames = 100;
  for (int i = 0; i < kFrames; ++i)
  {
    const auto [obs, T] = visit(i);
    map.insertObservation(obs, T);
  }
  const double perFrame = (mrpt::Clock::toDouble(mrpt::Clock::now()) - start) / kFrames;
  RecordProperty("milliseconds_per_frame", std::to_string(1e3 * perFrame));
  EXPECT_LT(perFrame, 0.02) << "2 ms expected; ten times that for slow or busy machines";
}

TEST(CQuadricObjectMap, PairsBoxesWithTheScanOfTheirFrame)
{
  // A cuboid of 0.5 x 0.4 x 0.4 m on the floor, ray-cast into a depth image.
  const TrueObject truth = cuboid("suitcase", {1.8, 0, 0.2}, {0.4, 0.5, 0.4}, 0.35);
  const auto T = SyntheticCamera::lookAt({0, 0, 1.1}, truth.object.center());
  SyntheticCamera camera(17);
  auto boxes = camera.observe(T, {truth});
  for (auto& d : boxes.objects) d.measurement = ObjectMeasurement();

  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = boxes.sensorLabel;
  scan.timestamp = boxes.timestamp;
  scan.cameraParams = boxes.cameraParams;
  scan.cameraParamsIntensity = boxes.cameraParams;
  scan.hasRangeImage = true;
  scan.range_is_depth = true;
  scan.rangeUnits = 0.001f;
  scan.rangeImage_setSize(480, 640);
  const auto T_map_optical = T + T_sensor_optical();
  const Eigen::Matrix3d R = T_map_optical.getRotationMatrix().asEigen();
  const Eigen::Vector3d eye(T.x(), T.y(), T.z());
  const Eigen::Matrix3d R_obj = truth.object.rotation();
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
    {
      const Eigen::Vector3d ray = R * camera.camera.ray(u, v);
      double depth = ray.z() < 0 ? -eye.z() / ray.z() : 0;
      const Eigen::Vector3d o = R_obj.transpose() * (eye - truth.object.center());
      const Eigen::Vector3d d = R_obj.transpose() * ray;
      const Eigen::Array3d a = (-truth.object.semiAxes() - o).array() / d.array();
      const Eigen::Array3d b = (truth.object.semiAxes() - o).array() / d.array();
      const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
      if (enter > 0 && enter < leave) depth = enter;
      if (depth > 6) depth = 0;
      scan.rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(1000 * depth));
    }

  for (const bool scanFirst : {true, false})
  {
    CQuadricObjectMap map;
    bool inserted = false;
    if (scanFirst) inserted = map.insertObservation(scan, T);
    EXPECT_FALSE(inserted);
    inserted = map.insertObservation(boxes, T);
    if (!scanFirst)
    {
      EXPECT_FALSE(inserted);
      inserted = map.insertObservation(scan, T);
    }
    EXPECT_TRUE(inserted);
    ASSERT_EQ(map.objects().size(), 1u);
    const auto& object = map.objects().begin()->second;
    EXPECT_EQ(object.completeCount, 1u);
    EXPECT_LT((object.object.center() - truth.object.center()).norm(), 0.06);
  }

  CQuadricObjectMap other;
  scan.sensorLabel = "another camera";
  other.insertObservation(scan, T);
  EXPECT_FALSE(other.insertObservation(boxes, T));
  EXPECT_TRUE(other.isEmpty());
}
