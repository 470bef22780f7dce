#include "quadmap/folders/FolderCheck.h"

#include <gtest/gtest.h>

#include <sstream>

#include "../../obs/TestData.h"
#include "../SampleRecording.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

namespace
{
FolderProblems check(const SampleRecording& recording, FolderCheckOptions options = {})
{
  return checkFolder(openFrameFolder("tum", recording.folder()), options, [](double) {});
}

/** Expects exactly one problem, of this kind and with this text. */
void expectOnly(const FolderProblems& problems, const std::string& kind, const std::string& part)
{
  ASSERT_EQ(problems.size(), 1u) << problems.begin()->first;
  ASSERT_EQ(problems.count(kind), 1u) << problems.begin()->first;
  ASSERT_EQ(problems.at(kind).size(), 1u);
  const std::string text = problems.at(kind)[0];
  EXPECT_NE(text.find(part), std::string::npos) << text;
}
}  // namespace

TEST(FolderCheck, FindsNothingInAGoodRecording)
{
  double last = -1;
  const SampleRecording recording;
  const auto problems = checkFolder(
      openFrameFolder("tum", recording.folder()), {}, [&](double share) { last = share; });
  EXPECT_TRUE(problems.empty()) << problems.begin()->first;
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(FolderCheck, FindsMissingFiles)
{
  const SampleRecording recording;
  for (const char* file : {"rgb/f1.png", "depth/f2.png", "detections/f3.txt"})
    std::filesystem::remove(recording.files.path(file));
  const auto problems = check(recording);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.at("missing file").size(), 3u);
  EXPECT_NE(problems.at("missing file")[0].find("rgb/f1.png"), std::string::npos);
  EXPECT_NE(problems.at("missing file")[0].find("associations.txt:2"), std::string::npos);
}

TEST(FolderCheck, FindsLinksInACircle)
{
  const SampleRecording recording;
  std::filesystem::remove(recording.files.path("depth/f1.png"));
  std::filesystem::create_symlink("f1.png", recording.files.path("depth/f1.png"));
  const std::string what = "depth/f1.png: Too many levels of symbolic links";
  expectOnly(check(recording), "list", what);
  FrameFolderOptions options;
  options.imagesAnywhere = true;
  const FrameFolder folder = openFrameFolder("tum", recording.folder(), options);
  expectOnly(checkFolder(folder, {}, [](double) {}), "image", what);
}

TEST(FolderCheck, FindsAWrongDepthScale)
{
  const SampleRecording recording;
  const auto withFactor = [&](const std::string& factor)
  {
    auto text = std::string(SampleRecording::kCalibration);
    text.replace(text.find("5000.0"), 6, factor);
    recording.writeCalibration(text);
    return check(recording);
  };
  expectOnly(withFactor("100000.0"), "depth scale", "between 0.1 and 0.1 m");
  expectOnly(withFactor("500.0"), "depth scale", "between 20 and 20 m");
  // A room of 1 to 3.6 m, read with the factor of other cameras.
  for (int i = 0; i < SampleRecording::kFrames; ++i)
    recording.writeDepth(i, 5000 + i * 13000 / (SampleRecording::kFrames - 1));
  expectOnly(withFactor("1000.0"), "depth scale", "between 5 and 18 m: depth_factor 1000 ");
  expectOnly(withFactor("25000.0"), "depth scale", "between 0.2 and 0.72 m: depth_factor 25000 ");
  EXPECT_TRUE(withFactor("5000.0").empty());
  FolderCheckOptions small;
  small.minDepth = 0.04;
  withFactor("100000.0");
  EXPECT_TRUE(check(recording, small).empty());
}

TEST(FolderCheck, DoesNotTakeAFewWrongPixelsForAWrongDepthScale)
{
  const SampleRecording recording;
  const auto withPixels = [&](int columns, int value)
  {
    cv::Mat image(48, 64, CV_16UC1, cv::Scalar(10000));
    image.row(0).colRange(0, columns).setTo(cv::Scalar(value));
    cv::imwrite(recording.files.path("depth/f0.png"), image);
    return check(recording);
  };
  // Of the 6 * 12 * 16 pixels looked at, 8 are 0.7 % and 16 are 1.4 %; 1 % may be wrong.
  EXPECT_TRUE(withPixels(32, 65000).empty());
  EXPECT_TRUE(withPixels(32, 500).empty());
  expectOnly(withPixels(64, 65000), "depth scale", "between 2 and 13 m");
  expectOnly(withPixels(64, 500), "depth scale", "between 0.1 and 2 m");
}

TEST(FolderCheck, FindsDepthImagesWithoutMeasurement)
{
  const SampleRecording recording;
  recording.writeDepth(4, 0);
  expectOnly(check(recording), "no depth", "depth/f4.png");
}

TEST(FolderCheck, FindsImagesOfAnotherSize)
{
  const SampleRecording recording;
  recording.writeColor(4, 63, 48);
  expectOnly(check(recording), "image", "rgb/f4.png: is 63x48");
}

TEST(FolderCheck, FindsGapsAndStepsBackInTime)
{
  const SampleRecording recording;
  std::string lines;
  const double times[] = {100.0, 100.1, 100.2, 100.15, 100.4, 101.0};
  for (int i = 0; i < SampleRecording::kFrames; ++i) lines += SampleRecording::line(i, times[i]);
  recording.files.write("associations.txt", lines);
  std::filesystem::remove(recording.files.path("groundtruth.txt"));
  auto problems = check(recording);
  expectOnly(problems, "time going backwards", "associations.txt:4: 0.050000 s before");
  FolderCheckOptions options;
  options.maxGap = 0.5;
  problems = check(recording, options);
  ASSERT_EQ(problems.size(), 2u);
  ASSERT_EQ(problems.at("gap in time").size(), 1u);
  EXPECT_NE(problems.at("gap in time")[0].find("associations.txt:6: 0.600 s"), std::string::npos);
}

TEST(FolderCheck, ComparesGapsWithTheMedianInterval)
{
  const SampleRecording recording;
  std::string lines;
  for (int i = 0; i < SampleRecording::kFrames; ++i)
    lines += SampleRecording::line(i, 100 + 0.1 * i + (i > 2 ? 0.45 : 0));
  recording.files.write("associations.txt", lines);
  std::filesystem::remove(recording.files.path("groundtruth.txt"));
  expectOnly(check(recording), "gap in time", "associations.txt:4: 0.550 s");
}

TEST(FolderCheck, FindsUnusableBoxes)
{
  const SampleRecording recording;
  recording.files.write(
      SampleRecording::boxesFile(2),
      "1 a 0.5 9 9 5 5\n1 b 0.5 70 1 90 9\n1 c 0.5 1 1 1 9\n1 d 0.5 nan 1 2 9\n1 e 7 1 1 9 9\n"
      "1 f 0.5 -1e300 -1e300 1e300 1e300\n1 good 0.5 1 1 9 9\n");
  recording.files.write(SampleRecording::boxesFile(3), "1 a 0.5\n");
  const auto problems = check(recording);
  ASSERT_EQ(problems.size(), 1u);
  const auto& boxes = problems.at("box");
  ASSERT_EQ(boxes.size(), 7u);
  const char* const parts[] = {"inverted", "outside", "no area", "not finite",
                               "score",    "far",     "columns"};
  for (std::size_t i = 0; i < boxes.size(); ++i)
    EXPECT_NE(boxes[i].find(parts[i]), std::string::npos) << boxes[i];
  EXPECT_NE(boxes[3].find("f2.txt:4: d (x1=nan"), std::string::npos) << boxes[3];
}

TEST(FolderCheck, FindsImagesWithMoreBoxesThanOneMayHave)
{
  const SampleRecording recording;
  std::string lines;
  for (int i = 0; i < 301; ++i) lines += "1 chair 0.5 1 1 9 9\n";
  recording.files.write(SampleRecording::boxesFile(2), lines);
  expectOnly(check(recording), "box", "f2.txt: has 301 boxes, of which the 300 ");
}

TEST(FolderCheck, FindsPosesThatJump)
{
  const SampleRecording recording;
  const auto withPoses = [&](const std::string& fourth)
  {
    std::string poses;
    for (int i = 0; i < SampleRecording::kFrames; ++i)
      poses += i == 3 ? fourth : SampleRecording::pose(i, 0.05 * i);
    recording.files.write("groundtruth.txt", poses);
    return check(recording);
  };
  auto problems = withPoses(SampleRecording::pose(3, 0.95));
  ASSERT_EQ(problems.size(), 1u);
  ASSERT_EQ(problems.at("pose jumps").size(), 2u) << "there and back";
  EXPECT_NE(problems.at("pose jumps")[0].find("associations.txt:4: 8.50 m/s"), std::string::npos);
  problems = withPoses("100.3 0.15 0 0 0 0.7071068 0 0.7071068\n");
  ASSERT_EQ(problems.at("pose jumps").size(), 2u);
  EXPECT_NE(problems.at("pose jumps")[0].find("900 deg/s"), std::string::npos);
  EXPECT_TRUE(withPoses(SampleRecording::pose(3, 0.2)).empty()) << "1 m/s is no jump";
}

TEST(FolderCheck, FindsFramesWithoutPose)
{
  const SampleRecording recording;
  std::string poses;
  for (int i = 0; i < SampleRecording::kFrames - 1; ++i) poses += SampleRecording::pose(i, 0);
  recording.files.write("groundtruth.txt", poses);
  expectOnly(check(recording), "no pose", "associations.txt:6");
}

TEST(FolderCheck, FindsPosesThatCannotBeRead)
{
  const SampleRecording recording;
  const std::string good = readFile(recording.files.path("groundtruth.txt"));
  recording.files.write("groundtruth.txt", "100.1 0 0\n" + good);
  expectOnly(check(recording), "pose", "groundtruth.txt:1");
  recording.files.write("groundtruth.txt", "100.1 0 0\n");
  expectOnly(check(recording), "pose", "groundtruth.txt:1");
  std::string nonsense;
  for (int i = 0; i < 1001; ++i) nonsense += "nonsense\n";
  recording.files.write("groundtruth.txt", nonsense + good);
  expectOnly(check(recording), "pose", "groundtruth.txt: more than 1000");
  recording.files.write("groundtruth.txt", "nonsense\n1 0 0 0 0 0 0 1\n");
  const auto ofAnotherTime = check(recording);
  EXPECT_EQ(ofAnotherTime.count("pose"), 1u);
  ASSERT_EQ(ofAnotherTime.count("no pose"), 1u);
  EXPECT_EQ(ofAnotherTime.at("no pose").size(), 6u);
  const auto last = good.rfind("100.5");
  recording.files.write(
      "groundtruth.txt", "100.1 0 0\n" + good.substr(0, last) + SampleRecording::pose(5, 9));
  EXPECT_EQ(check(recording).count("pose jumps"), 1u) << "the poses that are left are looked at";
}

TEST(FolderCheck, FindsLinesOfListsThatCannotBeRead)
{
  const SampleRecording recording;
  recording.files.write(
      "associations.txt",
      readFile(recording.files.path("associations.txt")) + "100.6 rgb/f5.png\n");
  expectOnly(check(recording), "list", "associations.txt:7: expected 4 columns, got 2");
}

TEST(FolderCheck, RejectsOptionsOutOfRange)
{
  const SampleRecording recording;
  const auto expect = [&](double FolderCheckOptions::*member, double value)
  {
    FolderCheckOptions options;
    options.*member = value;
    EXPECT_THROW(check(recording, options), std::invalid_argument);
  };
  expect(&FolderCheckOptions::maxGap, -1);
  expect(&FolderCheckOptions::minDepth, 0);
  expect(&FolderCheckOptions::maxDepth, 0.1);
  expect(&FolderCheckOptions::jumpFactor, 1);
  expect(&FolderCheckOptions::maxSpeed, 0);
  expect(&FolderCheckOptions::maxTurnRate_deg, 0);
}

TEST(FolderCheck, FindsNothingInTheRealRecordings)
{
  for (const char* name : {"tum_fr3_cabinet", "kitchen_a"})
  {
    const auto folder = testData(name);
    if (folder.empty()) GTEST_SKIP() << "the recordings are not here";
    EXPECT_TRUE(checkFolder(openFrameFolder("tum", folder), {}, [](double) {}).empty()) << name;
  }
}

TEST(FolderCheck, FindsOtherDepthFactorsInTheRealRecordings)
{
  namespace fs = std::filesystem;
  for (const char* name : {"tum_fr3_cabinet", "kitchen_a"})
  {
    const fs::path original = testData(name);
    if (original.empty()) GTEST_SKIP() << "the recordings are not here";
    const TemporaryFolder folder;
    for (const char* sub : {"rgb", "depth"})
      fs::create_directory_symlink(original / sub, folder.path(sub));
    std::istringstream lines(readFile((original / "associations.txt").string()));
    std::string line, some;
    for (int i = 0; std::getline(lines, line); ++i)
      if (i % 20 == 0) some += line + "\n";  // enough for percentiles
    folder.write("associations.txt", some);
    const std::string calibration = readFile((original / "calibration.yaml").string());
    const auto at = calibration.find("5000.0");
    ASSERT_NE(at, std::string::npos) << name;
    for (const auto& [factor, isWrong] :
         {std::pair("5000.0", false), std::pair("1000.0", true), std::pair("25000.0", true)})
    {
      folder.write("calibration.yaml", std::string(calibration).replace(at, 6, factor));
      FrameFolderOptions options;
      options.imagesAnywhere = true;  // they are links to those of the recording
      const auto problems =
          checkFolder(openFrameFolder("tum", folder.folder().string(), options), {}, [](double) {});
      EXPECT_EQ(problems.count("depth scale") > 0, isWrong) << name << " " << factor;
    }
  }
}
