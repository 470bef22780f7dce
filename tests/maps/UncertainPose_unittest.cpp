#include "quadmap/maps/UncertainPose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "../slam/SyntheticRoom.h"
#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
const std::vector<TrueObject> kWorld = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
const PoseNoise kError{0.05, 0.03};

/** Inserts twelve frames, each by a function of map, observation and pose. */
template <typename Insert>
CQuadricObjectMap mapBy(const Insert& insert)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(3);
  for (int i = 0; i < 12; ++i)
  {
    const CPose3D T = poseAround(i, 12);
    insert(map, camera.observe(T, kWorld), T);
  }
  return map;
}

/** Of a level pose, at which small changes of the angles are turns about the axes. */
CPose3DPDFGaussian gaussianOf(const CPose3D& T, const PoseNoise& error)
{
  CPose3DPDFGaussian pdf(T);
  for (int i = 0; i < 3; ++i) pdf.cov(i, i) = error.position * error.position;
  for (int i = 3; i < 6; ++i) pdf.cov(i, i) = error.angle * error.angle;
  return pdf;
}

void expectSameObject(const CQuadricObjectMap& a, const CQuadricObjectMap& b)
{
  ASSERT_EQ(a.objects().size(), 1u);
  ASSERT_EQ(b.objects().size(), 1u);
  EXPECT_EQ(uprightStateOf(a.objects().at(1).object), uprightStateOf(b.objects().at(1).object));
  EXPECT_EQ(a.objects().at(1).covariance, b.objects().at(1).covariance);
}

}  // namespace

TEST(UncertainPose, TakesTurnsFromTheAnglesOfAnyOrientation)
{
  CPose3DPDFGaussian pdf(CPose3D(1, 2, 3, 0.4, 1.1, -0.7));
  pdf.cov(0, 0) = 0.01;
  pdf.cov(1, 1) = 0.04;
  pdf.cov(2, 2) = 0.04;
  const Eigen::Vector3d sigmas(2e-3, 1e-3, 3e-3);  // of yaw, pitch, roll [rad]
  for (int i = 0; i < 3; ++i) pdf.cov(3 + i, 3 + i) = sigmas[i] * sigmas[i];
  pdf.cov(3, 5) = pdf.cov(5, 3) = 0.8 * sigmas[0] * sigmas[2];
  const UncertainPose pose = pdf;
  EXPECT_NEAR(pose.error.position, std::sqrt(0.03), 1e-12);

  // The angles of sampled turns away from the mean
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  const Eigen::Matrix3d R = pdf.mean.getRotationMatrix().asEigen();
  double sum = 0;
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i)
  {
    const double common = gauss(random);
    const double yaw = sigmas[0] * common, pitch = sigmas[1] * gauss(random);
    const double roll = sigmas[2] * (0.8 * common + 0.6 * gauss(random));
    const CPose3D sample(0, 0, 0, 0.4 + yaw, 1.1 + pitch, -0.7 + roll);
    const Eigen::Matrix3d turn = R.transpose() * sample.getRotationMatrix().asEigen();
    sum += std::pow(Eigen::AngleAxisd(turn).angle(), 2);
  }
  EXPECT_NEAR(pose.error.angle / std::sqrt(sum / kSamples / 3), 1.0, 0.02) << "1/sqrt(samples)";
}

TEST(UncertainPose, AddsToTheOptionsWhenItIsInserted)
{
  const auto given = mapBy([](auto& map, const auto& obs, const CPose3D& T)
                           { map.insertObservation(obs, UncertainPose(T, kError)); });
  const auto byOption = mapBy(
      [](auto& map, const auto& obs, const CPose3D& T)
      {
        map.insertionOptions.poseNoise = combined(InsertionOptions().poseNoise, kError);
        map.insertObservation(obs, T);
      });
  const auto plain =
      mapBy([](auto& map, const auto& obs, const CPose3D& T) { map.insertObservation(obs, T); });
  expectSameObject(given, byOption);
  EXPECT_EQ(given.insertionOptions.poseNoise.position, InsertionOptions().poseNoise.position);
  EXPECT_GT(given.objects().at(1).covariance(0, 0), 1.5 * plain.objects().at(1).covariance(0, 0));
}

TEST(UncertainPose, OfMrptIsTakenAsItIs)
{
  CQuadricObjectMap byMrpt, byNoise;
  SyntheticCamera camera(3);
  const auto obs = camera.observe({}, {cuboid("suitcase", {2, 0, 0}, {0.4, 0.4, 0.4}, 0)});
  EXPECT_TRUE(byMrpt.insertObservation(obs, gaussianOf({}, kError)));
  EXPECT_TRUE(byNoise.insertObservation(obs, UncertainPose({}, kError)));
  EXPECT_NEAR(
      byMrpt.objects().at(1).covariance(0, 0) / byNoise.objects().at(1).covariance(0, 0), 1, 1e-9);
  byMrpt.genericMapParams.enableObservationInsertion = false;
  EXPECT_FALSE(byMrpt.insertObservation(obs, gaussianOf({}, kError)));
}

TEST(UncertainPose, TellsWhatMatchWouldDecide)
{
  const auto map =
      mapBy([](auto& m, const auto& obs, const CPose3D& T) { m.insertObservation(obs, T); });
  SyntheticCamera camera(8);
  const CPose3D T = poseAround(2, 12);
  const auto obs = camera.observe(T, kWorld);
  CQuadricObjectMap unsure = map;
  unsure.insertionOptions.poseNoise = combined(map.insertionOptions.poseNoise, kError);
  const auto exact = map.match(obs, T), given = map.match(obs, UncertainPose(T, kError)),
             byOption = unsure.match(obs, T);
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_EQ(given.at(0).logPosteriorSecond, byOption.at(0).logPosteriorSecond);
  EXPECT_NE(given.at(0).logPosteriorSecond, exact.at(0).logPosteriorSecond);
}

TEST(UncertainPose, WaitsWithItsBoxesForTheScan)
{
  const SyntheticRoom room;
  const CPose3D T = room.robotAt(0);
  const auto scan = room.scanFrom(T, 1000.0);
  const auto boxes = room.boxesOf(*scan, T);
  CQuadricObjectMap boxesFirst, scanFirst, byOption, plain;
  EXPECT_FALSE(boxesFirst.insertObservation(*boxes, UncertainPose(T, kError)));
  EXPECT_TRUE(boxesFirst.insertObservation(*scan, T));
  EXPECT_FALSE(scanFirst.insertObservation(*scan, T));
  EXPECT_TRUE(scanFirst.insertObservation(*boxes, UncertainPose(T, kError)));
  expectSameObject(boxesFirst, scanFirst);
  byOption.insertionOptions.poseNoise = combined(InsertionOptions().poseNoise, kError);
  for (CQuadricObjectMap* map : {&byOption, &plain})
  {
    map->insertObservation(*scan, T);
    map->insertObservation(*boxes, T);
  }
  expectSameObject(boxesFirst, byOption);
  EXPECT_NE(boxesFirst.objects().at(1).covariance, plain.objects().at(1).covariance);
}
