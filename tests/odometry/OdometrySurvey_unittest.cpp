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

/** Writes the start of the home with negative fy. \param turned The stored images are upside down,
 * too, so that nothing else changes. \param covered They show nothing. */
std::string writeWithNegativeFy(const TemporaryFolder& folder, bool turned, bool covered = false)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (auto& frame : homeFrames(6))
  {
    if (covered) cover(frame);
    auto& scan = *frame.scan;
    if (turned)
    {
      scan.rangeImage = scan.rangeImage.asEigen().colwise().reverse().eval();
      scan.intensityImage.flipVertical();
    }
    for (auto* camera : {&scan.cameraParams, &scan.cameraParamsIntensity})
      camera->setIntrinsicParamsFromValues(camera->fx(), -camera->fy(), camera->cx(), camera->cy());
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
  EXPECT_EQ(survey.upOrigin, UpOrigin::Images) << "not asked for";
}

TEST(OdometrySurvey, ARawlogWithoutImagesIsReadOnce)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 40; ++i)
    records.push_back(samplePose(kStart + i, {}, "odometry " + std::to_string(i % 20)));
  int asked = 0;
  RawlogSourceOptions options;
  options.shouldStop = [&] { return ++asked < 0; };
  const auto file = writeObjects(folder.path("x.rawlog"), records);
  const auto survey = surveyOdometry(file, options, PoseSource::Auto);
  EXPECT_TRUE(survey.withoutImages);
  EXPECT_LT(asked, 50) << "records, of 20 kinds of odometry";
  EXPECT_FALSE(surveyOdometry(writeHome(folder, true), {}, PoseSource::Auto).withoutImages);
}

// A damaged rawlog may name any number of kinds, and each takes another look at it.
TEST(OdometrySurvey, TriesEightKindsOfOdometry)
{
  const TemporaryFolder folder;
  const auto looksFor = [&](int kinds)
  {
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (const auto& frame : homeFrames(2))
    {
      for (int i = 0; i < 40; ++i)  // as many records for any number of kinds
        records.push_back(
            samplePose(frame.time(), *frame.T_odom_robot, "wheels " + std::to_string(i % kinds)));
      records.push_back(frame.scan);
    }
    int asked = 0;
    RawlogSourceOptions options;
    options.shouldStop = [&] { return ++asked < 0; };
    const auto file = writeObjects(folder.path("x.rawlog"), records);
    surveyOdometry(file, options, PoseSource::Auto);
    return asked;
  };
  const int oneLook = looksFor(1), allLooks = looksFor(8);
  EXPECT_GT(allLooks, 8 * oneLook);
  EXPECT_LT(allLooks, 10 * oneLook);
  EXPECT_EQ(looksFor(20), allLooks);
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
  EXPECT_EQ(survey.warning("a.rawlog"), "");
}

TEST(OdometrySurvey, TheSourceThatCoversTheImagesBetterWinsInAnyOrder)
{
  const TemporaryFolder folder;
  for (const bool isFirst : {true, false})
  {
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (const auto& frame : homeFrames(15))
    {
      const auto good = samplePose(frame.time(), *frame.T_odom_robot);
      const auto ahead = samplePose(frame.time() + 1.5, *frame.T_odom_robot, "wheels");
      records.push_back(isFirst ? ahead : good);
      records.push_back(isFirst ? good : ahead);
      records.push_back(frame.scan);
    }
    const auto file = writeObjects(folder.path("x.rawlog"), records);
    const auto survey = surveyOdometry(file, {}, PoseSource::Auto);
    EXPECT_EQ(survey.odometryKind, "CObservationRobotPose odometry") << isFirst;
    EXPECT_EQ(bestOdometryKind(file, {}), survey.odometryKind) << isFirst;
  }
}

TEST(OdometrySurvey, OfEquallyGoodSourcesTheOrderOfRecordsChoosesNone)
{
  const TemporaryFolder folder;
  for (const bool isFirst : {true, false})
  {
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (const auto& frame : homeFrames(4))
    {
      records.push_back(samplePose(frame.time(), {}, isFirst ? "left" : "right"));
      records.push_back(samplePose(frame.time(), {}, isFirst ? "right" : "left"));
      records.push_back(frame.scan);
    }
    const auto file = writeObjects(folder.path("x.rawlog"), records);
    EXPECT_EQ(bestOdometryKind(file, {}), "CObservationRobotPose left") << isFirst;
  }
}

TEST(OdometrySurvey, TellsOfOdometryBehindTheImages)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> records, poses;
  for (const auto& frame : homeFrames(30))
  {
    records.push_back(frame.scan);
    poses.push_back(samplePose(frame.time(), *frame.T_odom_robot));
  }
  records.insert(records.end(), poses.begin(), poses.end());
  const auto file = writeObjects(folder.path("x.rawlog"), records);
  const auto survey = surveyOdometry(file, {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  EXPECT_EQ(survey.warning("a.rawlog"), "") << "not known yet";
  EXPECT_EQ(
      survey.warningOfLateOdometry("a.rawlog", "CObservationRobotPose odometry"),
      "a.rawlog: CObservationRobotPose odometry starts behind the first images, and visual "
      "odometry replaced it: records must be in the order of their times");
  EXPECT_EQ(survey.warningOfLateOdometry("a.rawlog", ""), "");
  const auto asked = surveyOdometry(file, {}, PoseSource::Visual);
  EXPECT_EQ(asked.warningOfLateOdometry("a.rawlog", "CObservationRobotPose odometry"), "");
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
  EXPECT_EQ(
      survey.warning("a.rawlog"),
      "a.rawlog: CObservationRobotPose odometry has no pose at the times of the first images (is a "
      "clock wrong?): visual odometry replaces it");
}

TEST(OdometrySurvey, FindsUpFromTheFloorWhenThereIsNone)
{
  const TemporaryFolder folder;
  const auto survey = surveyOdometry(writeHome(folder, false), {}, PoseSource::Auto);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  EXPECT_EQ(survey.upOrigin, UpOrigin::Floor);
  const Eigen::Vector3d truth =
      homeFrames(1)[0].T_world_robot->getRotationMatrix().asEigen().row(2).transpose();
  EXPECT_LT(std::acos(survey.up_robot.dot(truth)), 0.02) << "[rad]";
}

TEST(OdometrySurvey, WithNegativeFyTheFloorIsWhereImagesShowIt)
{
  const TemporaryFolder folder;
  const auto original = surveyOdometry(writeHome(folder, false), {}, PoseSource::Visual).up_robot;
  const auto upright = surveyOdometry(writeWithNegativeFy(folder, false), {}, PoseSource::Visual);
  EXPECT_EQ(upright.upOrigin, UpOrigin::Floor);
  const Eigen::Vector3d mirrored(original.x(), original.y(), -original.z());
  EXPECT_LT(std::acos(upright.up_robot.dot(mirrored)), 0.01) << "[rad]";
  const auto turned = surveyOdometry(writeWithNegativeFy(folder, true), {}, PoseSource::Visual);
  EXPECT_EQ(turned.upOrigin, UpOrigin::Floor);
  EXPECT_LT(std::acos(turned.up_robot.dot(original)), 0.01) << "[rad]";
}

TEST(OdometrySurvey, WithoutAFloorStoredImagesAreUpright)
{
  const TemporaryFolder folder;
  const auto survey =
      surveyOdometry(writeWithNegativeFy(folder, false, true), {}, PoseSource::Visual);
  EXPECT_EQ(survey.upOrigin, UpOrigin::Images);
  EXPECT_EQ(survey.up_robot, -Eigen::Vector3d::UnitZ());
}

TEST(OdometrySurvey, VisualOdometryWhenAskedFor)
{
  const TemporaryFolder folder;
  const auto survey = surveyOdometry(writeHome(folder, true), {}, PoseSource::Visual);
  EXPECT_EQ(survey.source, PoseSource::Visual);
  EXPECT_EQ(survey.upOrigin, UpOrigin::Floor);
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
  EXPECT_LT((direction->direction - (up + nearly).normalized()).norm(), 1e-12);
  EXPECT_EQ(direction->votes, 2u);
  EXPECT_FALSE(agreedDirection({}));
}
