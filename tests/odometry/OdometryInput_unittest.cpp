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
