#include "quadmap/odometry/VisualOdometry.h"

#include <gtest/gtest.h>
#include <mrpt/poses/Lie/SO.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>

#include "HomeFrames.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
using Poses = std::vector<std::optional<CPose3D>>;

Poses follow(VisualOdometry& odometry, const std::vector<RgbdFrame>& frames)
{
  Poses poses;
  for (const auto& frame : frames) poses.push_back(odometry.add(*frame.scan));
  return poses;
}

double angleOf(const CPose3D& pose)
{
  return mrpt::poses::Lie::SO<3>::log(pose.getRotationMatrix()).norm();
}

/** Expects the simulator's poses, as seen from its first one. The bounds are [m] and [rad]. */
void expectTruth(
    const Poses& poses, const std::vector<RgbdFrame>& frames, double distance, double angle)
{
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    if (!poses[i]) continue;
    const CPose3D truth = *frames[i].T_world_robot - *frames[0].T_world_robot;
    const CPose3D error = *poses[i] - truth;
    EXPECT_LT(error.norm(), distance) << "frame " << i;
    EXPECT_LT(angleOf(error), angle) << "frame " << i;
  }
}

std::size_t missing(const Poses& poses)
{
  return static_cast<std::size_t>(std::count(poses.begin(), poses.end(), std::nullopt));
}
}  // namespace

TEST(VisualOdometry, FollowsTheCamera)
{
  const auto frames = homeFrames(60);
  VisualOdometry odometry({});
  const auto poses = follow(odometry, frames);
  EXPECT_EQ(missing(poses), 0u);
  double way = 0;  // [m]
  for (std::size_t i = 1; i < frames.size(); ++i)
    way += (*frames[i].T_world_robot - *frames[i - 1].T_world_robot).norm();
  EXPECT_GT(way, 2.0);
  expectTruth(poses, frames, 0.02 * way, 0.025);
  EXPECT_EQ(odometry.counts().frames, 60u);
  EXPECT_EQ(odometry.counts().gaps, 0u);
  EXPECT_TRUE(odometry.takeWarnings().empty());
}

TEST(VisualOdometry, ImagesUpsideDownWithNegativeFyGiveTheSamePoses)
{
  const auto frames = homeFrames(20);
  std::vector<mrpt::serialization::CSerializable::Ptr> mirrored;
  for (const auto& frame : homeFrames(20))
  {
    auto& scan = *frame.scan;
    cv::Mat turned;
    cv::flip(scan.intensityImage.asCvMatRef(), turned, 0);
    scan.intensityImage = mrpt::img::CImage(turned, mrpt::img::DEEP_COPY);
    const auto depth = scan.rangeImage;
    for (int row = 0; row < depth.rows(); ++row)
      for (int column = 0; column < depth.cols(); ++column)
        scan.rangeImage(row, column) = depth(depth.rows() - 1 - row, column);
    for (auto* camera : {&scan.cameraParams, &scan.cameraParamsIntensity})
      camera->setIntrinsicParamsFromValues(
          camera->fx(), -camera->fy(), camera->cx(), camera->nrows - 1 - camera->cy());
    mirrored.push_back(frame.scan);
  }
  const TemporaryFolder folder;
  VisualOdometry ofOriginal({}), ofMirrored({});
  const auto expected = follow(ofOriginal, frames);
  const auto poses = follow(ofMirrored, readAll(writeObjects(folder.path("x.rawlog"), mirrored)));
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    ASSERT_TRUE(poses[i] && expected[i]) << i;
    EXPECT_LT((*poses[i] - *expected[i]).norm(), 1e-6) << i;
  }
}

TEST(VisualOdometry, StartsWhereItIsTold)
{
  const auto frames = homeFrames(5);
  const CPose3D start(1, 2, 3, 0.4, 0.5, 0.6);
  VisualOdometry fromOrigin({}), fromStart({}, start);
  const auto a = follow(fromOrigin, frames), b = follow(fromStart, frames);
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_LT((*b[i] - (start + *a[i])).norm(), 1e-9) << i;
}

TEST(VisualOdometry, StepsErrAsMuchAsTheirCovarianceSays)
{
  const auto frames = homeFrames(60);
  VisualOdometry odometry({});
  double sum = 0;
  std::optional<CPose3D> T_world_marked;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    ASSERT_TRUE(odometry.add(*frames[i].scan)) << i;
    if (i % 2 != 0) continue;  // steps over two images
    const auto step = odometry.takeStep();
    ASSERT_EQ(step.has_value(), i > 0);
    if (step)
    {
      const CPose3D truth = *frames[i].T_world_robot - *T_world_marked;
      const Eigen::Matrix<double, 6, 1> error =
          step->mean.asVectorVal().asEigen() - truth.asVectorVal().asEigen();
      const Eigen::Matrix<double, 6, 6> information = step->cov.asEigen().inverse();
      ASSERT_TRUE(information.allFinite());
      sum += error.dot(information * error) / 6;
    }
    T_world_marked = frames[i].T_world_robot;
  }
  const double mean = sum / 29;  // 1 when the covariances are right
  EXPECT_GT(mean, 0.3);
  EXPECT_LT(mean, 2.5);
}

TEST(VisualOdometry, SamePosesWhateverTheNumberOfThreads)
{
  auto frames = homeFrames(20);
  frames.erase(frames.begin() + 8, frames.begin() + 13);  // so that descriptors have work, too
  const int threads = cv::getNumThreads();
  std::vector<Poses> runs;
  for (const int n : {1, 4, 4})
  {
    cv::setNumThreads(n);
    VisualOdometry odometry({});
    runs.push_back(follow(odometry, frames));
  }
  cv::setNumThreads(threads);
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (const std::size_t run : {1u, 2u})
    {
      ASSERT_EQ(runs[run][i].has_value(), runs[0][i].has_value()) << i;
      if (!runs[0][i]) continue;
      EXPECT_EQ(runs[run][i]->asVectorVal(), runs[0][i]->asVectorVal()) << i;
    }
}

TEST(VisualOdometry, GoesOnAfterCoveredImagesWithoutInventingMotion)
{
  auto frames = homeFrames(30);
  for (const std::size_t i : {10u, 11u, 12u}) cover(frames[i]);
  VisualOdometry odometry({});
  const auto poses = follow(odometry, frames);
  for (const std::size_t i : {10u, 11u, 12u}) EXPECT_FALSE(poses[i]) << i;
  EXPECT_EQ(missing(poses), 3u);
  expectTruth(poses, frames, 0.04, 0.015);
  EXPECT_EQ(odometry.counts().failed, 3u);
  EXPECT_EQ(odometry.counts().gaps, 0u);
  EXPECT_EQ(odometry.takeWarnings().size(), 1u) << "one for the three";
}

TEST(VisualOdometry, BridgesAGapWithoutMotionButWithItsUncertainty)
{
  auto frames = homeFrames(60);
  frames.erase(frames.begin() + 10, frames.begin() + 50);  // another part of the room
  VisualOdometryOptions options;
  VisualOdometry odometry(options);
  Poses poses;
  for (std::size_t i = 0; i < 10; ++i) poses.push_back(odometry.add(*frames[i].scan));
  odometry.takeStep();
  EXPECT_FALSE(odometry.add(*frames[10].scan));
  EXPECT_FALSE(odometry.add(*frames[11].scan)) << "one image may be bad";
  const double gap = frames[12].time() - frames[9].time();
  ASSERT_GT(gap, options.maxGap);
  const auto after = odometry.add(*frames[12].scan);
  ASSERT_TRUE(after);
  EXPECT_LT((*after - *poses[9]).norm(), 1e-9) << "nobody knows";
  const auto step = odometry.takeStep();
  ASSERT_TRUE(step);
  EXPECT_NEAR(std::sqrt(step->cov(0, 0)), options.gapSpeed * gap, 0.1 * options.gapSpeed * gap);
  const double angle = std::min(M_PI, options.gapTurnRate * gap);
  EXPECT_NEAR(std::sqrt(step->cov(3, 3)), angle, 0.1 * angle);
  EXPECT_EQ(odometry.counts().gaps, 1u);
  const auto warnings = odometry.takeWarnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("does not know the motion"), std::string::npos);
  const CPose3D truth = *frames[17].T_world_robot - *frames[12].T_world_robot;
  std::optional<CPose3D> later;
  for (std::size_t i = 13; i <= 17; ++i) later = odometry.add(*frames[i].scan);
  ASSERT_TRUE(later);
  EXPECT_LT((*later - (*after + truth)).norm(), 0.02) << "on from there";
}

TEST(VisualOdometry, FindsNothingInCoveredImages)
{
  auto frames = homeFrames(5);
  for (auto& frame : frames) cover(frame);
  VisualOdometry odometry({});
  EXPECT_EQ(missing(follow(odometry, frames)), 5u);
  EXPECT_EQ(odometry.takeWarnings().size(), 1u);
}

TEST(VisualOdometry, DoesNotSlideAlongABlankWall)
{
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.004);  // [m]
  std::vector<RgbdFrame> frames = homeFrames(6);
  for (auto& frame : frames)
  {
    cover(frame);
    for (int v = 0; v < frame.scan->rangeImage.rows(); ++v)
      for (int u = 0; u < frame.scan->rangeImage.cols(); ++u)
        frame.scan->rangeImage(v, u) =
            static_cast<std::uint16_t>((2.0 + noise(random)) / frame.scan->rangeUnits);
  }
  VisualOdometry odometry({});
  const auto poses = follow(odometry, frames);
  EXPECT_EQ(missing(poses), 6u);
}

TEST(VisualOdometry, HasNoPosesWithoutBrightness)
{
  auto frames = homeFrames(3);
  for (auto& frame : frames) frame.scan->hasIntensityImage = false;
  VisualOdometry odometry({});
  EXPECT_EQ(missing(follow(odometry, frames)), 3u) << "surfaces alone slide";
}

TEST(VisualOdometry, GreyImagesDoAsWell)
{
  auto frames = homeFrames(30);
  for (auto& frame : frames) frame.scan->intensityImage = frame.scan->intensityImage.grayscale();
  VisualOdometry odometry({});
  const auto poses = follow(odometry, frames);
  EXPECT_EQ(missing(poses), 0u);
  expectTruth(poses, frames, 0.04, 0.015);
}

TEST(VisualOdometry, RefusesMotionNobodyMakes)
{
  const auto frames = homeFrames(3);
  VisualOdometryOptions options;
  options.maxSpeed = 1e-3;
  options.maxTurnRate = 1e-3;
  VisualOdometry odometry(options);
  const auto poses = follow(odometry, frames);
  EXPECT_TRUE(poses[0]);
  EXPECT_FALSE(poses[1]);
}

TEST(VisualOdometry, TooSmallImagesAreFailuresNotCrashes)
{
  auto frames = homeFrames(6);
  const int kBy = 4;  // 80x60 are left
  for (auto& frame : frames)
  {
    auto& scan = *frame.scan;
    const mrpt::math::CMatrix_u16 full = scan.rangeImage;
    scan.rangeImage_setSize(60, 80);
    for (int v = 0; v < 60; ++v)
      for (int u = 0; u < 80; ++u) scan.rangeImage(v, u) = full(kBy * v + 2, kBy * u + 2);
    scan.cameraParams.scaleToResolution(80, 60);
    scan.cameraParamsIntensity = scan.cameraParams;
    mrpt::img::CImage small;
    scan.intensityImage.scaleImage(small, 80, 60, mrpt::img::IMG_INTERP_AREA);
    scan.intensityImage = small;
  }
  VisualOdometry odometry({});
  EXPECT_FALSE(follow(odometry, frames)[0]);
  EXPECT_GT(odometry.counts().failed, 0u);
}
