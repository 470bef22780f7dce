#include "quadmap/odometry/OdometryInput.h"

#include <gtest/gtest.h>

#include "../geometry/Algebra.h"
#include "visual/HomeFrames.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

TEST(OdometryInput, AutoIsTheRawlogsOdometry)
{
  auto frames = homeFrames(2);
  frames[1].T_odom_robot.reset();
  OdometryInput input(PoseSource::Auto, {}, {});
  EXPECT_EQ(input.poseOf(frames[0])->asVectorVal(), frames[0].T_odom_robot->asVectorVal());
  EXPECT_FALSE(input.poseOf(frames[1])) << "no change of horses";
  EXPECT_FALSE(input.visualCounts());
  OdometryInput visual(PoseSource::Visual, {}, {});
  EXPECT_TRUE(visual.poseOf(frames[0]));
  EXPECT_TRUE(visual.poseOf(frames[1]));
  EXPECT_EQ(visual.visualCounts()->frames, 2u);
}

TEST(OdometryInput, EveryKeyframeStepHasAnInvertibleCovariance)
{
  for (const auto source : {PoseSource::Rawlog, PoseSource::Visual, PoseSource::GroundTruth})
  {
    OdometryInput input(source, {}, {});
    std::optional<CPose3D> before;
    for (const auto& frame : homeFrames(9))
    {
      const auto pose = input.poseOf(frame);
      ASSERT_TRUE(pose);
      const auto step = input.keyframeStep();
      ASSERT_EQ(step.has_value(), before.has_value());
      if (step)
      {
        EXPECT_LT((step->mean - (*pose - *before)).norm(), 1e-9) << nameOf(source);
        const Eigen::Matrix<double, 6, 6> cov = step->cov.asEigen();
        EXPECT_GT(eigenvaluesOf(cov)[0], 1e-9) << nameOf(source);
      }
      before = pose;
    }
  }
}

TEST(OdometryInput, TellsOfStepsThatNoRobotMakes)
{
  auto frames = homeFrames(40);
  const auto warning = [&](PoseSource source)
  {
    OdometryInput input(source, {}, {});
    for (const auto& frame : frames) input.poseOf(frame);
    return input.warningOfJumps();
  };
  EXPECT_EQ(warning(PoseSource::Rawlog), "");
  for (std::size_t k = 20; k < frames.size(); ++k)
    frames[k].scan->timestamp += std::chrono::minutes(2);
  for (std::size_t k = 20; k < frames.size(); ++k)
    *frames[k].T_odom_robot = CPose3D(50, 0, 0, 1, 0, 0) + *frames[k].T_odom_robot;
  EXPECT_EQ(warning(PoseSource::Rawlog), "") << "it went on while the recording paused";
  *frames[30].T_odom_robot = CPose3D(3, 0, 0, 0, 0, 0) + *frames[30].T_odom_robot;
  const std::string text = warning(PoseSource::Rawlog);
  EXPECT_NE(text.find("(2 in all)"), std::string::npos) << text;
  EXPECT_NE(
      text.find("before record " + std::to_string(frames[30].record) + " (camera)"),
      std::string::npos)
      << text;
  EXPECT_EQ(warning(PoseSource::GroundTruth), "") << "other poses";
  EXPECT_EQ(warning(PoseSource::Visual), "") << "it tells by itself";
  for (auto& frame : frames) frame.T_world_robot.reset();
  *frames[30].T_odom_robot = *frames[29].T_odom_robot + CPose3D(0, 0, 0, 3, 0, 0);
  EXPECT_NE(warning(PoseSource::Rawlog), "") << "a turn";
}

TEST(OdometryInput, StandsUprightAtTheStart)
{
  for (const double side : {1, -1})  // on its feet or on its head
  {
    const Eigen::Vector3d up_robot = Eigen::Vector3d(0.3, -0.2, 0.9 * side).normalized();
    OdometryInput input(PoseSource::Visual, {}, {}, up_robot);
    const auto pose = input.poseOf(homeFrames(1)[0]);
    ASSERT_TRUE(pose);
    const Eigen::Matrix3d R = pose->getRotationMatrix().asEigen();
    EXPECT_LT((R * up_robot - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
    EXPECT_GT(R(0, 0), 0.9) << "looks ahead";
  }
}

TEST(OdometryInput, VisualOdometryFollowsOneCameraAndSaysSo)
{
  auto frames = homeFrames(4);
  frames[1].scan->sensorLabel = frames[3].scan->sensorLabel = "rear";
  OdometryInput input(PoseSource::Visual, {}, {});
  EXPECT_TRUE(input.poseOf(frames[0]));
  EXPECT_FALSE(input.poseOf(frames[1]));
  EXPECT_TRUE(input.poseOf(frames[2]));
  EXPECT_FALSE(input.poseOf(frames[3]));
  EXPECT_EQ(input.visualSensor(), "camera");
  const auto warnings = input.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("rear"), std::string::npos);
}

TEST(OdometryInput, CountsTheImagesThatShouldHavePoses)
{
  auto frames = homeFrames(6);
  for (const std::size_t k : {1, 2, 4}) frames[k].T_odom_robot.reset();
  OdometryInput input(PoseSource::Rawlog, {}, {});
  EXPECT_EQ(input.missingPoses(), "");
  for (const auto& frame : frames) input.poseOf(frame);
  EXPECT_EQ(input.missingPoses(), "3 of 6 images have no pose");
  EXPECT_FALSE(input.lacksMostPoses());
  input.poseOf(frames[1]);
  EXPECT_TRUE(input.lacksMostPoses());

  frames[1].scan->sensorLabel = "rear";
  OdometryInput visual(PoseSource::Visual, {}, {});
  for (const std::size_t k : {0, 1, 2, 1, 1, 1}) visual.poseOf(frames[k]);
  EXPECT_EQ(visual.missingPoses(), "") << "of the one camera that visual odometry uses";
  EXPECT_FALSE(visual.lacksMostPoses());
}
