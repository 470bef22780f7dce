#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include "../SampleRawlog.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

namespace
{
constexpr int kDriveFrames = 120;

double timeOf(int frame) { return kStart + 0.1 * frame; }

/** A robot that drives along x at 1 m/s. Each image lies between two poses, the second of which
 * comes after it. \param more Gives further records to follow those of a frame. */
template <typename More>
Objects drive(const More& more)
{
  Objects records;
  for (int i = 0; i <= kDriveFrames; ++i)
  {
    records.push_back(samplePose(timeOf(i), CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
    if (i < kDriveFrames) records.push_back(sampleScan(timeOf(i) + 0.03));
    for (const auto& record : more(i)) records.push_back(record);
  }
  return records;
}

void expectAllPoses(const Objects& records, std::size_t expectedFrames = kDriveFrames)
{
  const TemporaryFolder folder;
  RawlogSource source(writeObjects(folder.path("x.rawlog"), records), {});
  source.logging_enable_console_output = false;
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), expectedFrames);
  EXPECT_EQ(source.odometryKind(), "CObservationRobotPose odometry");
  for (const auto& frame : frames)
  {
    ASSERT_TRUE(frame.T_odom_robot) << "frame " << frame.time() - kStart;
    EXPECT_NEAR(frame.T_odom_robot->x(), frame.time() - kStart, 1e-6);
  }
}

template <typename Observation>
Objects at(double time)
{
  auto o = Observation::Create();
  o->timestamp = stamp(time);
  o->sensorLabel = "other";
  return {o};
}
}  // namespace

TEST(WrongClocks, OneIgnoredPoseAnHourAheadLosesNothing)
{
  expectAllPoses(drive(
      [](int i)
      { return i == 39 ? Objects{samplePose(timeOf(i) + 3600, CPose3D(), "gps")} : Objects(); }));
}

TEST(WrongClocks, ASecondSourceAheadLosesNothing)
{
  for (const double ahead : {0.3, 1.5, 3600.0, -3600.0})
  {
    expectAllPoses(
        drive([&](int i) { return at<mrpt::obs::CObservationOdometry>(timeOf(i) + ahead); }));
    expectAllPoses(drive([&](int i) { return at<mrpt::obs::CObservationIMU>(timeOf(i) + ahead); }));
  }
}

TEST(WrongClocks, OneRecordAnHourAheadIsDroppedAlone)
{
  const TemporaryFolder folder;
  const auto truthAt = [](int i, double ahead)
  { return samplePose(timeOf(i) + ahead, CPose3D(0.1 * i, 0, 0, 0, 0, 0), "ground_truth"); };
  for (const std::string kind : {"odometry", "ground_truth", "camera"})
    for (const int bad : {0, 40})
    {
      SCOPED_TRACE(kind + " " + std::to_string(bad));
      Objects records;
      std::size_t badRecord = 0;
      for (int i = 0; i <= kDriveFrames; ++i)
      {
        const auto ahead = [&](const std::string& of)
        {
          if (of != kind || i != bad) return 0.0;
          badRecord = records.size();
          return 3600.0;
        };
        records.push_back(
            samplePose(timeOf(i) + ahead("odometry"), CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
        records.push_back(truthAt(i, ahead("ground_truth")));
        records.push_back(sampleScan(timeOf(i) + 0.03 + ahead("camera")));
      }
      const auto file = writeObjects(folder.path("x.rawlog"), records);
      const std::string expected =
          file + ": record " + std::to_string(badRecord) + " (" + kind +
          "): the time is 3599.900000 s ahead of that of the next record of this sensor";
      EXPECT_EQ(errorOf([&] { readAll(file); }), expected);

      RawlogSourceOptions options;
      options.keepGoing = true;
      RawlogSource source(file, options);
      const auto frames = readAll(source);
      ASSERT_EQ(source.problems().size(), 1u);
      EXPECT_EQ(source.problems()[0].text(), expected);
      EXPECT_EQ(frames.size(), kDriveFrames + (kind == "camera" ? 0u : 1u));
      std::size_t posed = 0, withTruth = 0;
      for (const auto& frame : frames)
      {
        posed += frame.T_odom_robot ? 1 : 0;
        withTruth += frame.T_world_robot ? 1 : 0;
        if (!frame.T_odom_robot) continue;
        EXPECT_NEAR(frame.T_odom_robot->x(), frame.time() - kStart, 1e-6);
      }
      // The last image has no pose behind it, and the first none before it when that one is bad.
      const auto without = [&](const std::string& of) { return of == kind && bad == 0 ? 1u : 0u; };
      const unsigned all = kDriveFrames - (kind == "camera" ? 1u : 0u);
      EXPECT_EQ(posed, all - without("odometry"));
      EXPECT_EQ(withTruth, all - without("ground_truth"));
    }
}

TEST(WrongClocks, APauseIsNoWrongClock)
{
  Objects records;
  for (int i = 0; i < 6; ++i)
  {
    const double time = kStart + 100 * i;
    records.push_back(samplePose(time, CPose3D(100 * i, 0, 0, 0, 0, 0)));
    records.push_back(sampleScan(time));
  }
  expectAllPoses(records, 6);
}

TEST(WrongClocks, AnotherCameraAheadKeepsItsImagesToItself)
{
  const Objects records = drive(
      [](int i) -> Objects
      { return i % 10 == 0 ? Objects{sampleScan(timeOf(i) + 3600, "other")} : Objects(); });
  const TemporaryFolder folder;
  std::size_t posed = 0;
  for (const auto& frame : readAll(writeObjects(folder.path("x.rawlog"), records)))
  {
    EXPECT_EQ(frame.T_odom_robot.has_value(), frame.scan->sensorLabel == "camera");
    posed += frame.T_odom_robot ? 1 : 0;
  }
  EXPECT_EQ(posed, std::size_t{kDriveFrames});
}

TEST(WrongClocks, OdometryMayBeWrittenTwoSecondsLate)
{
  Objects records;
  for (int i = 0; i < kDriveFrames + 20; ++i)
  {
    if (i < kDriveFrames) records.push_back(sampleScan(timeOf(i)));
    if (i >= 20)
      records.push_back(samplePose(timeOf(i - 20), CPose3D(0.1 * (i - 20), 0, 0, 0, 0, 0)));
    if (i == 0) records.push_back(samplePose(timeOf(-1), CPose3D(-0.1, 0, 0, 0, 0, 0)));
  }
  expectAllPoses(records);
}

TEST(WrongClocks, OneListOfBoxesAheadDoesNotEndTheWaitingForOthers)
{
  Objects records;
  for (int i = 0; i < 40; ++i)
  {
    records.push_back(samplePose(timeOf(i), CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
    records.push_back(sampleScan(timeOf(i)));
    if (i == 9) records.push_back(sampleBoxes(timeOf(i) + 3600));
    if (i >= 3) records.push_back(sampleBoxes(timeOf(i - 3)));  // a detector takes its time
  }
  const TemporaryFolder folder;
  std::size_t withBoxes = 0;
  RawlogSource source(writeObjects(folder.path("x.rawlog"), records), {});
  source.logging_enable_console_output = false;
  for (const auto& frame : readAll(source)) withBoxes += frame.objects ? 1 : 0;
  // Three each at the start, at the wrong clock and at the end, where the detector stops.
  EXPECT_EQ(withBoxes, 31u);
}
