#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../slam/SyntheticRoom.h"
#include "ObjectMapFixture.h"
#include "quadmap/perception/FramePerception.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** A map of the room's box, made without scans. */
CQuadricObjectMap mapOf(const SyntheticRoom& room)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  walkAround(
      map, camera,
      {
          {room.label, room.box}
  },
      24, room.box.center());
  map.consolidate();
  return map;
}

/** Boxes without measurements, as a detector gives them. */
CObservationObjects detected(SyntheticCamera& camera, const CPose3D& T)
{
  auto obs = camera.observe(T, kitchen());
  for (auto& object : obs.objects) object.measurement = {};
  return obs;
}

}  // namespace

TEST(MapLikelihood, PeaksAtTheTruePose)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  walkAround(map, camera, kitchen(), 40, {0, 0, 0.5}, 2.8);
  for (const double partial : {0.0, 1.0})
  {
    camera.disturbances.partialProbability = partial;
    const auto T = SyntheticCamera::lookAt({2.5, 1.0, 1.5}, {0, 0, 0.5});
    const auto obs = camera.observe(T, kitchen());
    ASSERT_TRUE(map.canComputeObservationLikelihood(obs));
    const double best = map.computeObservationLikelihood(obs, T);
    for (const double step : {-1.0, -0.5, -0.25, 0.25, 0.5, 1.0})
    {
      EXPECT_LT(
          map.computeObservationLikelihood(obs, mrpt::poses::CPose3D(step, 0, 0, 0, 0, 0) + T),
          best);
      EXPECT_LT(
          map.computeObservationLikelihood(obs, mrpt::poses::CPose3D(0, step, 0, 0, 0, 0) + T),
          best);
      const mrpt::poses::CPose3D turned(T.x(), T.y(), T.z(), T.yaw() + 0.5 * step, T.pitch(), 0);
      EXPECT_LT(map.computeObservationLikelihood(obs, turned), best) << step << " yaw";
    }
  }
}

TEST(MapLikelihood, LocalisesByImportanceSampling)
{
  // What a particle filter does in one step: weight poses in a room, take the mean.
  CQuadricObjectMap map;
  SyntheticCamera camera(2);
  walkAround(map, camera, kitchen(), 40, {0, 0, 0.5}, 2.8);
  const auto T = SyntheticCamera::lookAt({2.5, 1.0, 1.5}, {0, 0, 0.5});
  const auto obs = camera.observe(T, kitchen());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> around(-1, 1);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double total = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const mrpt::poses::CPose3D sample(
        T.x() + 1.5 * around(random), T.y() + 1.5 * around(random), T.z(),
        T.yaw() + 0.5 * around(random), T.pitch(), 0);
    const double weight = std::exp(map.computeObservationLikelihood(obs, sample));
    mean += weight * Eigen::Vector3d(sample.x(), sample.y(), sample.yaw());
    total += weight;
  }
  mean /= total;
  EXPECT_NEAR(mean.x(), T.x(), 0.15);
  EXPECT_NEAR(mean.y(), T.y(), 0.15);
  EXPECT_NEAR(mean.z(), T.yaw(), 0.08);
}

TEST(MapLikelihood, SaysWhatItCannotCompute)
{
  const CQuadricObjectMap map = smallMap();
  EXPECT_FALSE(map.canComputeObservationLikelihood(mrpt::obs::CObservation3DRangeScan()));
  EXPECT_FALSE(map.canComputeObservationLikelihood(CObservationObjects()));
  CObservationObjects unmeasured;
  unmeasured.objects.emplace_back();
  EXPECT_FALSE(map.canComputeObservationLikelihood(unmeasured));
}

TEST(MapLikelihood, UnmeasuredBoxesSayWhatTheirEdgesSay)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  walkAround(map, camera, kitchen(), 40, {0, 0, 0.5}, 2.8);
  const auto T = SyntheticCamera::lookAt({2.5, 1.0, 1.5}, {0, 0, 0.5});
  const auto boxes = detected(camera, T);
  ASSERT_TRUE(map.canComputeObservationLikelihood(boxes));
  const double best = map.computeObservationLikelihood(boxes, T);
  EXPECT_NE(best, 0);
  for (const double step : {-1.0, -0.5, 0.5, 1.0})
  {
    EXPECT_LT(map.computeObservationLikelihood(boxes, CPose3D(step, 0, 0, 0, 0, 0) + T), best);
    EXPECT_LT(map.computeObservationLikelihood(boxes, CPose3D(0, step, 0, 0, 0, 0) + T), best);
    const CPose3D turned(T.x(), T.y(), T.z(), T.yaw() + 0.5 * step, T.pitch(), 0);
    EXPECT_LT(map.computeObservationLikelihood(boxes, turned), best) << step;
  }
  const CPose3D behind(-T.x(), -T.y(), T.z(), T.yaw(), T.pitch(), 0);
  const double nothing =
      static_cast<double>(boxes.objects.size()) * std::log(map.likelihoodOptions.outlierShare);
  EXPECT_NEAR(map.computeObservationLikelihood(boxes, behind), nothing, 1e-9)
      << "objects behind the camera explain no box";
}

TEST(MapLikelihood, OneUsableEdgeSaysSomething)
{
  const SyntheticRoom room;
  const CQuadricObjectMap map = mapOf(room);
  const CPose3D T = room.robotAt(0);
  auto boxes = *room.boxesOf(*room.scanFrom(T, 1000), T);
  auto& box = boxes.objects.at(0).box;
  box.y1 = 0;
  box.x2 = room.camera.width - 1;
  box.y2 = room.camera.height - 1;
  ASSERT_TRUE(map.canComputeObservationLikelihood(boxes));
  const double best = map.computeObservationLikelihood(boxes, T);
  const double turned = map.computeObservationLikelihood(boxes, T + CPose3D(0, 0, 0, 0.3, 0, 0));
  EXPECT_GT(best, std::log(0.5));
  EXPECT_LT(turned, best - 1);
  box.x1 = 0;
  EXPECT_FALSE(map.canComputeObservationLikelihood(boxes)) << "every edge is at the border";
}

TEST(MapLikelihood, UnmeasuredBoxesAreMeasuredWithTheScanThatWaitsForThem)
{
  const SyntheticRoom room;
  CQuadricObjectMap map = mapOf(room);
  const CPose3D T = room.robotAt(0.2);
  const auto scan = room.scanFrom(T, 1000);
  const auto boxes = *room.boxesOf(*scan, T);
  const double byEdges = map.computeObservationLikelihood(boxes, T);
  map.insertObservation(*scan, T);
  const double byDepth = map.computeObservationLikelihood(boxes, T);

  CObservationObjects measured = boxes;
  const Eigen::Vector3d up =
      (T + boxes.sensorPose).getRotationMatrix().asEigen().row(2).transpose();
  FramePerception(map.perceptionOptions, map.labels()).measure(*scan, measured, up);
  ASSERT_EQ(measured.objects.at(0).measurement.kind, MeasurementKind::Complete);
  EXPECT_EQ(byDepth, map.computeObservationLikelihood(measured, T));
  EXPECT_NE(byDepth, byEdges);
  CObservationObjects cut = boxes;
  cut.objects.at(0).box = {
      0, 0, static_cast<double>(room.camera.width - 1),
      static_cast<double>(room.camera.height - 1)};
  EXPECT_TRUE(map.canComputeObservationLikelihood(cut)) << "the scan knows more than the edges";
  EXPECT_TRUE(map.insertObservation(boxes, T)) << "the scan still waits";
}

TEST(MapLikelihood, BoxesWithoutCalibrationAreAnError)
{
  const CQuadricObjectMap map = smallMap();
  CObservationObjects boxes;
  EXPECT_EQ(map.computeObservationLikelihood(boxes, {}), 0) << "no box says nothing";
  boxes.objects.emplace_back();
  boxes.objects[0].box = {10, 10, 20, 20};
  boxes.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_FALSE(map.canComputeObservationLikelihood(boxes));
  EXPECT_THROW(map.computeObservationLikelihood(boxes, {}), std::runtime_error);
}

TEST(MapLikelihood, BoxesOfLowScoreSayNothing)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(7);
  const auto T = SyntheticCamera::lookAt({2.5, 1.0, 1.5}, {0, 0, 0.5});
  auto obs = camera.observe(T, kitchen());
  for (auto& object : obs.objects) object.score = 0.4;
  EXPECT_TRUE(map.canComputeObservationLikelihood(obs));
  map.insertionOptions.minScore = 0.5;
  EXPECT_FALSE(map.canComputeObservationLikelihood(obs));
  obs.objects[0].score = 0.6;
  EXPECT_TRUE(map.canComputeObservationLikelihood(obs));
}

TEST(MapLikelihood, BoxesWithoutACalibrationAreRefused)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(8);
  const auto T = SyntheticCamera::lookAt({2.5, 1.0, 1.5}, {0, 0, 0.5});
  auto obs = camera.observe(T, kitchen());
  obs.sensorLabel = "front";
  obs.cameraParams.cx(std::nan(""));
  EXPECT_FALSE(map.canComputeObservationLikelihood(obs));
  for (const bool inserts : {true, false}) try
    {
      if (inserts)
        map.insertObservation(obs, T);
      else
        map.computeObservationLikelihood(obs, T);
      ADD_FAILURE() << "accepted";
    }
    catch (const std::runtime_error& e)
    {
      EXPECT_NE(
          std::string(e.what()).find("\"front\" has no usable calibration"), std::string::npos)
          << e.what();
    }
}
