#include <gtest/gtest.h>

#include "../sensors/SampleRawlog.h"
#include "ImportFixture.h"

using namespace quadmap;

TEST_F(QuadmapImport, SaysHowManyFramesHaveNoPose)
{
  recording_.files.write("groundtruth.txt", SampleRecording::pose(0, 0));
  const auto result = run("tum IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: 5 of 6 frames have no pose in groundtruth.txt"), kNotFound);
}

TEST_F(QuadmapImport, SaysThatNoFrameHasAPose)
{
  recording_.files.write("groundtruth.txt", "1 0 0 0 0 0 0 1\n");
  const std::string what = "warning: 6 of 6 frames have no pose in groundtruth.txt";
  EXPECT_NE(run("tum IN -o OUT/x.rawlog").err.find(what), kNotFound);
  EXPECT_EQ(run("tum IN -o OUT/y.rawlog --poses-as none").err.find(what), kNotFound);
}

TEST_F(QuadmapImport, TellsOfPosesThatCannotBeReadAndOfTheRest)
{
  recording_.files.write("groundtruth.txt", SampleRecording::pose(0, 0) + "nonsense\n");
  const auto checked = run("tum IN --check");
  EXPECT_EQ(checked.status, 1);
  EXPECT_NE(checked.out.find("frames: 6 in"), kNotFound) << checked.out;
  EXPECT_NE(checked.out.find("groundtruth.txt:2: "), kNotFound) << checked.out;
  expectImportFailure(run("tum IN -o OUT/x.rawlog"), "groundtruth.txt:2: ");
  const auto without = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_NE(without.err.find("dropped: "), kNotFound) << without.err;
  EXPECT_NE(without.err.find("5 of 6 frames have no pose"), kNotFound) << without.err;
  EXPECT_EQ(run("tum IN -o OUT/y.rawlog --poses-as none").status, 0);
}

// A list of images that is cut off names an image that is not there, which is told as that.
TEST_F(QuadmapImport, TellsOfPosesThatMayBeCut)
{
  const auto expectNote = [&](const std::string& command, const std::string& file)
  {
    EXPECT_EQ(run(command).err, "") << file << " is whole";
    const std::string path = recording_.files.path(file), whole = readFile(path);
    recording_.files.write(file, whole.substr(0, whole.size() - 1));
    const auto result = run(command);
    recording_.files.write(file, whole);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("note: " + path + ": ends without a line break: "), kNotFound)
        << result.err;
  };
  for (const char* command : {"tum IN -o OUT/x.rawlog", "tum IN --check"})
    expectNote(command, "groundtruth.txt");
  expectNote(
      "rawlog OUT/x.rawlog -o OUT/y.rawlog --trajectory IN/groundtruth.txt", "groundtruth.txt");
}

TEST_F(QuadmapImport, TakesPosesAsAsked)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as ground-truth").status, 0);
  auto frame = readAll(out_.path("x.rawlog")).at(0);
  EXPECT_TRUE(frame.T_world_robot);
  EXPECT_FALSE(frame.T_odom_robot);
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as none").status, 0);
  frame = readAll(out_.path("x.rawlog")).at(0);
  EXPECT_FALSE(frame.T_world_robot || frame.T_odom_robot);
}

TEST_F(QuadmapImport, TruePosesOfARawlogStay)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as ground-truth").status, 0);
  std::string elsewhere;
  for (int i = 0; i < SampleRecording::kFrames; ++i) elsewhere += SampleRecording::pose(i, 7);
  recording_.files.write("odometry.tum", elsewhere);
  const auto result = run(
      "rawlog OUT/x.rawlog -o OUT/y.rawlog --poses-as ground-truth --trajectory IN/odometry.tum");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("6 frames, 6 poses as ground-truth"), kNotFound) << result.out;
  const auto before = readAll(out_.path("x.rawlog")), after = readAll(out_.path("y.rawlog"));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    ASSERT_TRUE(after[i].T_world_robot);
    EXPECT_LT((*after[i].T_world_robot - *before[i].T_world_robot).norm(), 1e-9);
    EXPECT_FALSE(after[i].T_odom_robot);
  }
}

TEST_F(QuadmapImport, CountsTheFramesOfARawlogWithoutAPose)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as none").status, 0);
  EXPECT_EQ(run("rawlog OUT/x.rawlog -o OUT/y.rawlog").err, "") << "it has none at all";
  recording_.files.write("start.tum", SampleRecording::pose(0, 0) + SampleRecording::pose(1, 0.05));
  const auto result = run("auto OUT/x.rawlog -o OUT/y.rawlog --trajectory IN/start.tum");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("warning: 4 of 6 frames have no pose in "), kNotFound) << result.err;
  EXPECT_NE(result.err.find("start.tum"), kNotFound) << result.err;
}

TEST_F(QuadmapImport, OneBadLineOfATrajectoryLosesOnePose)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as none").status, 0);
  const std::string good = readFile(recording_.files.path("groundtruth.txt"));
  for (const char* line : {"nonsense\n", "1 0 0 0 0 0 0 1\n"})
  {
    recording_.files.write("t.tum", good + line);
    const std::string command = "rawlog OUT/x.rawlog -o OUT/y.rawlog --trajectory IN/t.tum";
    expectImportFailure(run(command), "t.tum:7: ");
    const auto kept = run(command + " --keep-going");
    EXPECT_EQ(kept.status, 0) << kept.err;
    EXPECT_NE(kept.err.find("dropped: "), kNotFound) << kept.err;
    EXPECT_NE(kept.out.find("6 poses"), kNotFound) << kept.out;
  }
}

TEST_F(QuadmapImport, KeepsGoingWithoutATrajectoryOfTooManyBadLines)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as odometry").status, 0);
  std::string lines = readFile(recording_.files.path("groundtruth.txt"));
  for (int i = 0; i < 1001; ++i) lines += "nonsense\n";
  recording_.files.write("t.tum", lines);
  const std::string command = "rawlog OUT/x.rawlog -o OUT/y.rawlog --trajectory IN/";
  expectImportFailure(run(command + "t.tum"), "t.tum: more than 1000 entries cannot be used");
  const auto kept = run(command + "t.tum --keep-going");
  EXPECT_EQ(kept.status, 0) << kept.err;
  EXPECT_NE(kept.err.find("t.tum: more than 1000 entries"), kNotFound) << kept.err;
  EXPECT_NE(kept.out.find("6 frames, 0 poses"), kNotFound) << kept.out;
  expectImportFailure(run(command + "none.tum --keep-going"), "none.tum: cannot be read");
}

TEST_F(QuadmapImport, RefusesATrajectoryOfAnotherTime)
{
  recording_.files.write("other.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const std::string command = "rawlog OUT/x.rawlog -o OUT/y.rawlog --trajectory IN/other.tum";
  const std::string what = "other.tum: has no pose at the time of any frame of ";
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as ground-truth").status, 0);
  expectImportFailure(run(command + " --poses-as ground-truth"), what);
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --poses-as none").status, 0);
  expectImportFailure(run(command), what);
  const auto kept = run(command + " --keep-going");
  EXPECT_EQ(kept.status, 0);
  EXPECT_NE(kept.err.find("6 of 6 frames have no pose in "), kNotFound) << kept.err;
}

TEST_F(QuadmapImport, TakesTheOdometryThatCoversTheFramesOfARawlog)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 8; ++i)
  {
    const mrpt::poses::CPose3D pose(0.1 * i, 0, 0, 0, 0, 0);
    records.push_back(samplePose(kStart + 0.5 * i + 1.5, pose, "wheels"));
    records.push_back(samplePose(kStart + 0.5 * i, pose));
    records.push_back(sampleScan(kStart + 0.5 * i));
  }
  writeObjects(out_.path("x.rawlog"), records);
  const auto check = run("rawlog OUT/x.rawlog --check");
  EXPECT_NE(check.out.find("odometry for 8 frames (CObservationRobotPose odometry)"), kNotFound)
      << check.out;
  ASSERT_EQ(run("rawlog OUT/x.rawlog -o OUT/y.rawlog").status, 0);
  const auto frames = readAll(out_.path("y.rawlog"));
  ASSERT_EQ(frames.size(), 8u);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(frames[i].T_odom_robot.value().x(), 0.1 * i, 1e-9);
}

TEST_F(QuadmapImport, TellsOfOdometryBehindTheFramesOfARawlog)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 20; ++i) records.push_back(sampleScan(kStart + 0.5 * i));
  for (int i = 0; i < 20; ++i) records.push_back(samplePose(kStart + 0.5 * i, {}));
  writeObjects(out_.path("x.rawlog"), records);
  const auto result = run("rawlog OUT/x.rawlog -o OUT/y.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("of 20 frames have no pose in "), kNotFound) << result.err;
  EXPECT_EQ(run("rawlog OUT/x.rawlog --check").status, 1) << "frames without a pose";
}
