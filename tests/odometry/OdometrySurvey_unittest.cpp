#include "quadmap/odometry/OdometrySurvey.h"

#include <gtest/gtest.h>

#include "visual/HomeFrames.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** Writes the start of the recording of the home. */
std::string writeHome(const TemporaryFolder& folder, bool odometry)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (const auto& frame : homeFrames(6))
  {
    if (odometry) records.push_back(samplePose(frame.time(), *frame.T_odom_robot));
    records.push_back(frame.scan);
  }
  return writeObjects(folder.path("x.rawlog"), records);
}
}  // namespace

TEST(OdometrySurvey, TakesTheRawlogsOdometryWhenThereIsSome)
{
  const TemporaryFolder folder;
  const auto survey = surveyOdometry(writeHome(folder, true), {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Auto);
  EXPECT_FALSE(survey.up_robot) << "not asked for";
}

TEST(OdometrySurvey, ASecondSourceAheadOfTheImagesChangesNothing)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (const auto& frame : homeFrames(6))
  {
    // Poses lie around the image, so that the second one has to be waited for.
    records.push_back(samplePose(frame.time() - 0.01, *frame.T_odom_robot));
    records.push_back(frame.scan);
    records.push_back(samplePose(frame.time() + 1.5, *frame.T_odom_robot, "other"));
  }
  const auto file = writeObjects(folder.path("x.rawlog"), records);
  const auto survey = surveyOdometry(file, {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Auto);
  EXPECT_EQ(survey.uselessKind, "");
}

TEST(OdometrySurvey, TellsOfOdometryThatFitsNoImage)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (const auto& frame : homeFrames(6))
  {
    records.push_back(samplePose(frame.time() - 3600, *frame.T_odom_robot));
    records.push_back(frame.scan);
  }
  const auto survey =
      surveyOdometry(writeObjects(folder.path("x.rawlog"), records), {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  EXPECT_EQ(survey.uselessKind, "CObservationRobotPose odometry");
}

TEST(OdometrySurvey, FindsUpFromTheFloorWhenThereIsNone)
{
  const TemporaryFolder folder;
  const auto survey = surveyOdometry(writeHome(folder, false), {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  ASSERT_TRUE(survey.up_robot);
  const Eigen::Vector3d truth =
      homeFrames(1)[0].T_world_robot->getRotationMatrix().asEigen().row(2).transpose();
  EXPECT_LT(std::acos(survey.up_robot->dot(truth)), 0.02) << "[rad]";
}

TEST(OdometrySurvey, VisualOdometryWhenAskedFor)
{
  const TemporaryFolder folder;
  const auto survey = surveyOdometry(writeHome(folder, true), {}, PoseSource::Visual);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  EXPECT_TRUE(survey.up_robot);
}

TEST(OdometrySurvey, ASingleMomentNeedsNoOdometry)
{
  const TemporaryFolder folder;
  const auto frames = homeFrames(1);
  const auto file = writeObjects(folder.path("x.rawlog"), {frames[0].scan});
  EXPECT_EQ(surveyOdometry(file, {}, {}).source, PoseSource::Auto);
}

TEST(OdometrySurvey, TwoImagesOfOneCameraAreMoreThanAMoment)
{
  const TemporaryFolder folder;
  auto frames = homeFrames(2);
  frames[1].scan->timestamp =
      frames[0].scan->timestamp + std::chrono::milliseconds(33);  // a camera with 30 Hz
  auto file = writeObjects(folder.path("x.rawlog"), {frames[0].scan, frames[1].scan});
  EXPECT_EQ(surveyOdometry(file, {}, {}).source, PoseSource::Visual);
  frames[1].scan->sensorLabel = "rear";
  file = writeObjects(folder.path("y.rawlog"), {frames[0].scan, frames[1].scan});
  EXPECT_EQ(surveyOdometry(file, {}, {}).source, PoseSource::Auto) << "of two it is one";
}

TEST(OdometrySurvey, LeavesErrorsToTheRun)
{
  const TemporaryFolder folder;
  EXPECT_EQ(surveyOdometry(folder.path("nothing.rawlog"), {}, {}).source, PoseSource::Auto);
}

TEST(OdometrySurvey, DirectionIsTheOneMostAgreeOn)
{
  const Eigen::Vector3d up(0, 0, 1), wall(1, 0, 0);
  const Eigen::Vector3d nearly = Eigen::Vector3d(0.02, 0, 1).normalized();
  const auto direction = agreedDirection({wall, up, nearly});
  ASSERT_TRUE(direction);
  EXPECT_LT((*direction - (up + nearly).normalized()).norm(), 1e-12);
  EXPECT_FALSE(agreedDirection({}));
}
