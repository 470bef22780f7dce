#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <string>
#include <tuple>
#include <vector>

#include "../SampleRawlog.h"
#include "odometry/RecordClock.h"

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

/** Records in a row whose clock is an hour ahead: those of one source, from one frame on. */
struct Burst
{
  std::string of;  // label
  int first, count;

  double ahead(const std::string& label, int i) const
  {
    return label == of && i >= first && i < first + count ? 3600 : 0;
  }
};

/** A drive with true poses. \param strays Receives the indices of the burst's records, and of the
 * first of their sensor behind them. */
Objects driveWith(const Burst& burst, std::vector<std::size_t>& strays)
{
  Objects records;
  const auto add = [&](const std::string& label, int i, auto&& make)
  {
    const double ahead = burst.ahead(label, i);
    if (ahead > 0 || (burst.of == label && i == burst.first + burst.count))
      strays.push_back(records.size());
    records.push_back(make(timeOf(i) + ahead));
  };
  for (int i = 0; i <= kDriveFrames; ++i)
  {
    const CPose3D pose(0.1 * i, 0, 0, 0, 0, 0);
    for (const std::string label : {"odometry", "ground_truth"})
      add(label, i, [&](double time) { return samplePose(time, pose, label); });
    add("camera", i, [](double time) { return sampleScan(time + 0.03); });
  }
  return records;
}

class AheadForAWhile : public testing::TestWithParam<std::tuple<std::string, int, int>>
{
};

TEST_P(AheadForAWhile, ItsRecordsAreDroppedAlone)
{
  const std::string kind = std::get<0>(GetParam());
  const int first = std::get<1>(GetParam()), count = std::get<2>(GetParam());
  std::vector<std::size_t> strays;
  const Objects records = driveWith({kind, first, count}, strays);
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), records);
  const auto expected = [&](int k)
  {
    return file + ": record " + std::to_string(strays.at(static_cast<std::size_t>(k))) + " (" +
           kind + "): the time is " + std::to_string(3600 - 0.1 * (count - k)) +
           " s ahead of that of record " + std::to_string(strays.back()) + " of this sensor";
  };
  EXPECT_EQ(errorOf([&] { readAll(file); }), expected(0));

  RawlogSourceOptions options;
  options.keepGoing = true;
  RawlogSource source(file, options);
  const auto frames = readAll(source);
  ASSERT_EQ(source.problems().size(), static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    EXPECT_EQ(source.problems()[static_cast<std::size_t>(k)].text(), expected(k));
  EXPECT_EQ(
      frames.size(), static_cast<std::size_t>(kDriveFrames + 1 - (kind == "camera" ? count : 0)));
  int posed = 0, withTruth = 0;
  for (const auto& frame : frames)
  {
    posed += frame.T_odom_robot ? 1 : 0;
    withTruth += frame.T_world_robot ? 1 : 0;
    if (!frame.T_odom_robot) continue;
    EXPECT_NEAR(frame.T_odom_robot->x(), frame.time() - kStart, 1e-6);
  }
  // The last image has no pose behind it, and the first none before them when those are bad.
  const auto without = [&](const std::string& of)
  { return kind == "camera" || (of == kind && first == 0) ? count : 0; };
  EXPECT_EQ(posed, kDriveFrames - without("odometry"));
  EXPECT_EQ(withTruth, kDriveFrames - without("ground_truth"));
}

INSTANTIATE_TEST_SUITE_P(
    WrongClocks,
    AheadForAWhile,
    testing::Combine(
        testing::Values("odometry", "ground_truth", "camera"),
        testing::Values(0, 40),
        testing::Values(1, 2, 3, 8)));

TEST(WrongClocks, AClockThatIsSetForwardForGoodIsBelieved)
{
  const auto jumped = [](int i) { return timeOf(i) + (i < 40 ? 0 : 3600); };
  Objects records;
  for (int i = 0; i <= kDriveFrames; ++i)
  {
    records.push_back(samplePose(jumped(i), CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
    if (i < kDriveFrames) records.push_back(sampleScan(jumped(i) + 0.03));
  }
  const TemporaryFolder folder;
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), records));
  ASSERT_EQ(frames.size(), std::size_t{kDriveFrames});
  for (std::size_t i = 0; i < frames.size(); ++i)  // the jump itself has no poses around it
    EXPECT_EQ(frames[i].T_odom_robot.has_value(), i != 39) << i;
}

TEST(WrongClocks, AJumpIsBelievedWhenTenRecordsHaveFollowed)
{
  RecordClock clock;
  std::size_t record = 0;
  for (; record < 20; ++record)
    EXPECT_TRUE(clock.advance(0.1 * static_cast<double>(record), record).empty());
  const double before = clock.latest();
  EXPECT_NEAR(before, 1.9, 1e-9);
  for (int i = 0; i < 10; ++i, ++record) EXPECT_TRUE(clock.advance(3600 + 0.5 * i, record).empty());
  EXPECT_EQ(clock.latest(), before);
  EXPECT_EQ(clock.lastBefore(2), before) << "it may still come back";
  EXPECT_EQ(clock.lastBefore(1.8), 3604.5) << "but not to what was before";
  EXPECT_TRUE(clock.advance(3605, record).empty());
  EXPECT_EQ(clock.latest(), 3605);
  EXPECT_EQ(clock.lastBefore(2), 3605);
}

TEST(WrongClocks, RareRecordsAreNoStraysBeforeOneThatGoesBack)
{
  RecordClock clock;
  for (std::size_t i = 0; i < 8; ++i) clock.advance(4.3 * static_cast<double>(i), i);
  EXPECT_NEAR(clock.latest(), 6 * 4.3, 1e-9);
  EXPECT_NEAR(clock.lastBefore(2 * 4.3), 7 * 4.3, 1e-9);
}

TEST(WrongClocks, StraysMayBeAheadOfEachOther)
{
  RecordClock clock;
  for (std::size_t i = 0; i < 20; ++i) clock.advance(0.1 * static_cast<double>(i), i);
  clock.advance(3600, 20);
  clock.advance(5000, 21);
  const auto last = clock.advance(3600.2, 22);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].record, 21u);
  const auto both = clock.advance(2.3, 23);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].record, 20u);
  EXPECT_EQ(both[1].record, 22u);
  EXPECT_EQ(clock.latest(), 2.3);
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
    if (i == 19) records.push_back(sampleBoxes(timeOf(i) + 3600));
    if (i >= 3) records.push_back(sampleBoxes(timeOf(i - 3)));  // a detector takes its time
  }
  const TemporaryFolder folder;
  std::size_t withBoxes = 0;
  RawlogSource source(writeObjects(folder.path("x.rawlog"), records), {});
  source.logging_enable_console_output = false;
  for (const auto& frame : readAll(source)) withBoxes += frame.objects ? 1 : 0;
  // Three each are lost at the wrong clock and at the end, where the detector stops.
  EXPECT_EQ(withBoxes, 34u);
}
