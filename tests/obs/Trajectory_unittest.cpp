#include "quadmap/obs/Trajectory.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <ctime>
#include <fstream>
#include <utility>
#include <vector>

#include "TemporaryFolder.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
double distance(const CPose3D& a, const CPose3D& b)
{
  return (a.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
          b.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen())
      .norm();
}
}  // namespace

TEST(ReadTumTrajectory, ReadsPosesBetweenCommentsAndBlankLines)
{
  const TemporaryFolder folder;
  // A quarter turn about z is the quaternion (0, 0, sin 45, cos 45), here with two decimals.
  const auto trajectory = readTumTrajectory(folder.write(
      "t.tum",
      "# time tx ty tz qx qy qz qw\n\n"
      "1305031102.175304 1 2 3 0 0 0 1\n"
      "1305031102.211214\t-1.5 2e-1 3 0 0 0.71 0.71  # remark\r\n"));
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_DOUBLE_EQ(trajectory[0].time, 1305031102.175304);
  EXPECT_LT(distance(trajectory[0].pose, CPose3D(1, 2, 3, 0, 0, 0)), 1e-12);
  EXPECT_LT(distance(trajectory[1].pose, CPose3D(-1.5, 0.2, 3, M_PI / 2, 0, 0)), 1e-12);
}

TEST(ReadTumTrajectory, NamesFileAndLineOfWhatIsWrong)
{
  const TemporaryFolder folder;
  const std::vector<std::pair<const char*, const char*>> cases{
      {      "1 2 3 4 0 0 1",                     "expected 8 columns, got 7"},
      {  "1 2 3 4 0 0 0 1 9",                     "expected 8 columns, got 9"},
      {    "1,2,3,4,0,0,0,1",                     "expected 8 columns, got 1"},
      {   "1 2 3 4x 0 0 0 1",                   "'4x' is not a finite number"},
      {  "1 nan 3 4 0 0 0 1",                  "'nan' is not a finite number"},
      {  "1 2 3 4 0 0 inf 1",                  "'inf' is not a finite number"},
      {  "one 2 3 4 0 0 0 1",                  "'one' is not a finite number"},
      {"1e300 2 3 4 0 0 0 1",                 "'1e300' is no time in seconds"},
      {    "1 2 3 4 0 0 0 0",                            "quaternion is zero"},
      {"1 2 3 4 1e300 0 0 0", "quaternion has the length 1e+300 instead of 1"},
      {   "1 2 3 4 0 0 0 .7",    "quaternion has the length 0.7 instead of 1"},
      {    "1 2 3 4 0 0 1 1",   "quaternion has the length 1.41 instead of 1"}
  };
  for (const auto& [line, message] : cases)
  {
    const auto path =
        folder.write("gt.txt", std::string("# heading\n1 0 0 0 0 0 0 1\n") + line + "\n");
    EXPECT_EQ(errorOf([&] { readTumTrajectory(path); }), path + ":3: " + message);
  }
}

TEST(ReadTumTrajectory, ReadsFourHundredThousandPosesAndNoMore)
{
  std::string lines;
  for (int i = 0; i < 400'000; ++i) lines += "1 0 0 0 0 0 0 1\n";
  const TemporaryFolder folder;
  EXPECT_EQ(readTumTrajectory(folder.write("most.tum", lines)).size(), 400'000U);
  const auto path = folder.write("many.tum", lines + "1 0 0 0 0 0 0 1\n");
  const auto error = errorOf([&] { readTumTrajectory(path); });
  EXPECT_NE(error.find(path + ": has more than the 400000 poses"), std::string::npos) << error;
}

TEST(ReadTumTrajectory, PassesOverBlankLinesAsFastAsTheyAreRead)
{
  const TemporaryFolder folder;
  const auto path = folder.write("t.tum", std::string(8'000'000, '\n') + "1 0 0 0 0 0 0 1\n");
  const auto secondsOf = [](const auto& work)
  {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  std::size_t lines = 0;
  const double plain = secondsOf(
      [&]
      {
        std::ifstream file(path);
        for (std::string line; std::getline(file, line);) ++lines;
      });
  EXPECT_EQ(lines, 8'000'001u);
  EXPECT_LT(secondsOf([&] { EXPECT_EQ(readTumTrajectory(path).size(), 1u); }), 20 * plain + 0.2);
}

TEST(ReadTumTrajectory, NamesAFileThatCannotBeRead)
{
  const TemporaryFolder folder;
  const auto missing = folder.path("missing.tum");
  EXPECT_NE(errorOf([&] { readTumTrajectory(missing); }).find(missing), std::string::npos);
  const auto itself = folder.folder().string();  // a folder opens, but cannot be read
  EXPECT_NE(errorOf([&] { readTumTrajectory(itself); }).find(itself), std::string::npos);
}

TEST(ReadTrajectoryInOrder, LeavesOutSingleLines)
{
  const auto at = [](const char* time) { return std::string(time) + " 0 0 0 0 0 0 1\n"; };
  const std::string after = " s is after those of the poses behind it";
  const struct
  {
    std::string lines;
    std::vector<double> times;
    std::string unusable;  // behind "FILE:"
  } cases[] = {
      {            at("1") + "2 0\n" + at("3"),{1, 3},    "2: expected 8 columns, got 2"                                                          },
      {at("1") + at("2") + at("1.5") + at("3"),
       {1, 2, 3},
       "3: time 1.500000 s is not after the pose before"                                               },
      {at("1") + at("9e9") + at("2") + at("3"), {1, 2, 3},          "2: time 9000000000.000000" + after},
      {at("9e9") + at("1") + at("1") + at("2"),    {1, 2},          "1: time 9000000000.000000" + after},
      {at("1") + "1 5 0 0 0 0 0 1\n" + at("2"),    {1, 2},   "2: line 1 has another pose at 1.000000 s"},
      {            at("1") + at("1") + at("2"),    {1, 2},                                           ""},
  };
  const TemporaryFolder folder;
  for (const auto& c : cases)
  {
    const auto path = folder.write("gt.txt", c.lines);
    std::vector<std::string> unusable;
    std::vector<double> times;
    for (const auto& pose : readTrajectoryInOrder(path, unusable)) times.push_back(pose.time);
    EXPECT_EQ(times, c.times) << c.lines;
    std::vector<std::string> expected;
    if (!c.unusable.empty()) expected.push_back(path + ":" + c.unusable);
    EXPECT_EQ(unusable, expected) << c.lines;
  }
}

TEST(ReadTrajectoryInOrder, RefusesAFileOfWrongLines)
{
  const TemporaryFolder folder;
  std::string lines;
  for (int i = 0; i < 1001; ++i) lines += "x\n";
  const auto path = folder.write("gt.txt", lines);
  std::vector<std::string> unusable;
  EXPECT_EQ(
      errorOf([&] { readTrajectoryInOrder(path, unusable); }),
      path + ": more than 1000 entries cannot be used, such as " + path +
          ":1: expected 8 columns, got 1");
}

TEST(WriteTumTrajectory, ReadsBackTheSame)
{
  const TemporaryFolder folder;
  const Trajectory written{
      {1305031102.175304,       CPose3D(1,   -2, 3,  0.1, 0.2,  0.3)},
      {     1305031103.5, CPose3D(-100.25, 1e-4, 0, -3.1, 1.5, -2.9)},
      {     1305031104.0,       CPose3D(0,    0, 0, M_PI,   0,    0)}
  };
  const auto path = folder.path("t.tum");
  writeTumTrajectory(path, written);
  const Trajectory read = readTumTrajectory(path);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    EXPECT_NEAR(read[i].time, written[i].time, 1e-6);
    EXPECT_LT(distance(read[i].pose, written[i].pose), 1e-8) << "nine decimals";
  }
}

TEST(WriteTumTrajectory, SaysWhereItCannotWrite)
{
  EXPECT_THROW(writeTumTrajectory("/nonexistent/t.tum", {}), std::runtime_error);
}

TEST(PoseAt, TurnsAndMovesEvenlyBetweenTwoSamples)
{
  const Trajectory trajectory{
      {10, CPose3D(0, 0, 0,   0, 0, 0)},
      {11, CPose3D(4, 2, 0, 0.8, 0, 0)},
      {12, CPose3D(5, 2, 0, 0.8, 0, 0)}
  };
  const auto pose = poseAt(trajectory, 10.25, 1.5);
  ASSERT_TRUE(pose);
  EXPECT_LT(distance(*pose, CPose3D(1, 0.5, 0, 0.2, 0, 0)), 1e-12);
  EXPECT_LT(distance(*poseAt(trajectory, 11, 1.5), trajectory[1].pose), 1e-15);
  EXPECT_LT(distance(*poseAt(trajectory, 10, 1.5), trajectory[0].pose), 1e-15);
  EXPECT_LT(distance(*poseAt(trajectory, 12, 1.5), trajectory[2].pose), 1e-15);
}

TEST(PoseAt, TurnsTheShortWay)
{
  const Trajectory trajectory{
      {0, CPose3D(0, 0, 0,  3.0, 0, 0)},
      {1, CPose3D(0, 0, 0, -3.0, 0, 0)}
  };
  EXPECT_LT(distance(*poseAt(trajectory, 0.5, 2), CPose3D(0, 0, 0, M_PI, 0, 0)), 1e-12);
}

TEST(PoseAt, KnowsNothingOutsideTheSamplesAndInLongGaps)
{
  const Trajectory trajectory{
      {10, CPose3D()},
      {11, CPose3D()},
      {14, CPose3D()}
  };
  EXPECT_FALSE(poseAt(trajectory, 9.999, 5));
  EXPECT_FALSE(poseAt(trajectory, 14.001, 5));
  EXPECT_FALSE(poseAt(trajectory, 12, 2.9));
  EXPECT_TRUE(poseAt(trajectory, 12, 3.0));
  EXPECT_TRUE(poseAt(trajectory, 14, 0.1)) << "a sample itself needs no neighbour";
  EXPECT_FALSE(poseAt({}, 0, 1));
}
