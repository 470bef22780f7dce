#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "../folders/SampleRecording.h"
#include "../obs/TestData.h"
#include "../sensors/SampleRawlog.h"
#include "RunProgram.h"

using namespace quadmap;

namespace
{
/** A good recording to spoil, and a folder for what is written. */
class QuadmapImport : public ::testing::Test
{
 protected:
  /** Arguments with IN for the recording and OUT for the output folder. */
  ProgramResult run(const std::string& arguments)
  {
    return runProgram(
        "quadmap-import",
        replaced(replaced(arguments, "IN", recording_.folder()), "OUT", out_.folder().string()));
  }

  SampleRecording recording_;
  TemporaryFolder out_;
};

void expectFailure(const ProgramResult& result, const std::string& part)
{
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_EQ(result.err.find("quadmap-import: "), 0u) << result.err;
  EXPECT_NE(result.err.find(part), kNotFound) << "'" << part << "' is not in: " << result.err;
}
}  // namespace

TEST_F(QuadmapImport, WritesRawlogAndBoxes)
{
  const auto result = run("tum IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.err.empty()) << "no progress bar when redirected: " << result.err;
  EXPECT_NE(result.out.find("6 frames, 6 poses as odometry, 6 boxes"), kNotFound) << result.out;
  EXPECT_EQ(out_.fileCount(), 2u);
  const auto frames = readAll(out_.path("x.rawlog"));
  ASSERT_EQ(frames.size(), 6u);
  for (const auto& frame : frames)
  {
    EXPECT_TRUE(frame.T_odom_robot);
    EXPECT_FALSE(frame.T_world_robot);
    ASSERT_TRUE(frame.objects);
    EXPECT_EQ(frame.objects->objects.at(0).label, "chair");
  }
  EXPECT_NEAR(frames[5].T_odom_robot->x(), 0.25, 1e-9);
}

TEST_F(QuadmapImport, TellsTheKindOfAFolder)
{
  EXPECT_EQ(run("auto IN -o OUT/x.rawlog").status, 0);
  EXPECT_EQ(readAll(out_.path("x.rawlog")).size(), 6u);
  EXPECT_NE(run("auto IN --check").out.find(" (tum)\n"), kNotFound);
  expectFailure(run("auto OUT -o OUT/y.rawlog"), "tum has associations.txt");
}

TEST_F(QuadmapImport, SaysWhichKindMayBeMeant)
{
  const std::string message = run("scanet IN --check").err;
  EXPECT_NE(message.find(", got 'scanet'; did you mean scannet?"), kNotFound) << message;
}

TEST_F(QuadmapImport, SaysWhatIsThere)
{
  std::filesystem::remove(recording_.files.path("detections/f1.txt"));
  const auto result = run("tum IN --check");
  for (const char* part :
       {"frames: 6 in 0.5 s, colour and depth as associations.txt says\n",
        "camera: calibration.yaml, 64x48, fx 60, fy 62, cx 31.5, cy 23.5\n",
        "poses: 6 of 6 frames, of groundtruth.txt\n  up: (0.000, -1.000, 0.000) in the world of "
        "the "
        "poses, as calibration.yaml says\n",
        "detections (a line per box), 5 boxes; "
        "missing for 1 images\n",
        "missing file (1)\n"})
    EXPECT_NE(result.out.find(part), kNotFound) << "'" << part << "' is not in " << result.out;
  std::filesystem::remove(recording_.files.path("groundtruth.txt"));
  std::filesystem::remove_all(recording_.files.path("detections"));
  const auto less = run("tum IN --check");
  EXPECT_EQ(less.status, 0) << less.out;
  EXPECT_NE(
      less.out.find(
          "poses: none\n  up: left to quadmap-slam, as there are no poses\n  detections: none\n"),
      kNotFound)
      << less.out;
}

TEST_F(QuadmapImport, TakesTheCameraByNameOrFile)
{
  recording_.files.write(
      "my.ini", "[camera]\nwidth = 64\nheight = 48\nfx = 50\nfy = 50\ncx = 31\ncy = 23\n");
  EXPECT_EQ(run("tum IN -o OUT/x.rawlog --camera IN/my.ini").status, 0);
  EXPECT_DOUBLE_EQ(readAll(out_.path("x.rawlog")).at(0).scan->cameraParams.fx(), 50);
  EXPECT_EQ(run("tum IN -o OUT/x.rawlog --camera IN/calibration.yaml").status, 0);
  EXPECT_DOUBLE_EQ(readAll(out_.path("x.rawlog")).at(0).scan->cameraParams.fx(), 60);
  expectFailure(run("tum IN -o OUT/y.rawlog --camera kinekt"), "kinekt: no such camera; known are");
}

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
  expectFailure(run("tum IN -o OUT/x.rawlog"), "groundtruth.txt:2: ");
  const auto without = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_NE(without.err.find("dropped: "), kNotFound) << without.err;
  EXPECT_NE(without.err.find("6 of 6 frames have no pose"), kNotFound) << without.err;
  EXPECT_EQ(run("tum IN -o OUT/y.rawlog --poses-as none").status, 0);
}

TEST_F(QuadmapImport, RefusesResultsOfOtherImages)
{
  const std::string file = recording_.files.write(
      "r.json", R"([{"image_id": "other", "category_id": 0, "bbox": [1, 2, 3, 4]}])");
  const std::string boxes =
      " --detections " + file + " --labels " + recording_.files.write("my.names", "tv\n");
  const std::string what = "none of its boxes is of an image of ";
  expectFailure(run("tum IN -o OUT/x.rawlog" + boxes), what);
  const auto kept = run("tum IN -o OUT/x.rawlog --keep-going" + boxes);
  EXPECT_EQ(kept.status, 0);
  EXPECT_NE(kept.err.find("warning: "), kNotFound) << kept.err;
}

TEST_F(QuadmapImport, SaysThatUpIsNotKnown)
{
  auto calibration = std::string(SampleRecording::kCalibration);
  recording_.writeCalibration(calibration.substr(0, calibration.find("world_up")));
  const auto result = run("tum IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("up: taken as +z, as nothing says where it is"), kNotFound);
  EXPECT_NE(run("tum IN --check").out.find("  up: taken as +z"), kNotFound);
}

/** A recording whose camera sees planes, and does not say where up is. */
class UpOfPlanes : public QuadmapImport
{
 protected:
  /** \param normals Of planes that are 1.2 m from the camera and look at it; optical frame. */
  void show(const std::vector<Eigen::Vector3d>& normals)
  {
    constexpr int kColumns = 320, kRows = 240;
    constexpr double kFocal = 300, kCx = 159.5, kCy = 119.5;  // [px]
    recording_.writeCalibration(
        "fx: 300.0\nfy: 300.0\ncx: 159.5\ncy: 119.5\nwidth: 320\nheight: 240\n"
        "depth_factor: 5000.0\n");
    cv::Mat depth(kRows, kColumns, CV_16UC1);
    for (int v = 0; v < kRows; ++v)
      for (int u = 0; u < kColumns; ++u)
      {
        const Eigen::Vector3d ray((u - kCx) / kFocal, (v - kCy) / kFocal, 1);
        double nearness = 0;  // of the nearest plane
        for (const auto& n : normals) nearness = std::max(nearness, -n.dot(ray));
        depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(5000 * 1.2 / nearness);
      }
    for (int i = 0; i < SampleRecording::kFrames; ++i)
    {
      recording_.writeColor(i, kColumns, kRows);
      cv::imwrite(recording_.files.path(mrpt::format("depth/f%d.png", i)), depth);
    }
  }

  /** Imports it. \param up Optical frame. \param by How the program says it found that. */
  void expectUp(const Eigen::Vector3d& up, const std::string& by)
  {
    const auto result = run("tum IN -o OUT/x.rawlog");
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find(by), kNotFound) << result.err;
    const auto frames = readAll(out_.path("x.rawlog"));
    const Eigen::Vector3d up_robot(up.z(), -up.x(), -up.y());  // x forward, y left, z up
    const Eigen::Vector3d up_map =
        frames.at(0).T_odom_robot->getRotationMatrix().asEigen() * up_robot;
    EXPECT_GT(up_map.z(), std::cos(mrpt::DEG2RAD(1.0))) << up_map.transpose();
  }
};

TEST_F(UpOfPlanes, IsTheFloors)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.8, -0.6).normalized();
  show({up});
  expectUp(up, "by the floor in 6 images of 6");
}

TEST_F(UpOfPlanes, IsAlongTwoWalls)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.9, -0.3).normalized();
  const Eigen::Vector3d left = up.cross(Eigen::Vector3d(1, 0, -1)).normalized();
  const Eigen::Vector3d right = up.cross(left);
  show({left.z() < 0 ? left : -left, right.z() < 0 ? right : -right});
  expectUp(up, "by horizontal and vertical surfaces in 6 images of 6 without a floor");
}

TEST_F(QuadmapImport, FindsTheUpOfARealRecording)
{
  const auto raw = testData("seven_scenes_raw"), kitchen = testData("kitchen_a");
  if (raw.empty() || kitchen.empty()) GTEST_SKIP() << "the recordings are not here";
  const auto result = run("auto " + raw + " -o OUT/raw.rawlog");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("by the floor in "), kNotFound) << result.err;
  ASSERT_EQ(run("tum " + kitchen + " -o OUT/kitchen.rawlog --every 8").status, 0);
  const auto found = readAll(out_.path("raw.rawlog")), known = readAll(out_.path("kitchen.rawlog"));
  ASSERT_EQ(found.size(), 31u);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i].time(), known[i].time(), 1e-3);
    const auto upOf = [](const RgbdFrame& frame)
    { return Eigen::Vector3d(frame.T_odom_robot->getRotationMatrix().asEigen().row(2)); };
    // The two sets of poses differ by 1.4 to 3.7 degrees from each other.
    EXPECT_GT(upOf(found[i]).dot(upOf(known[i])), std::cos(mrpt::DEG2RAD(4.5))) << i;
  }
}

TEST_F(QuadmapImport, ReadsBoxesOfOtherForms)
{
  const TemporaryFolder boxes;
  for (int i = 0; i < SampleRecording::kFrames; ++i)
    boxes.write(mrpt::format("f%d.txt", i), "1 0.5 0.5 0.5 0.5 0.75\n");
  boxes.write("my.names", "desk\noffice chair\n");
  const std::string folder = boxes.folder().string();
  const auto result =
      run("tum IN -o OUT/x.rawlog --detections " + folder + " --labels " + boxes.path("my.names"));
  ASSERT_EQ(result.status, 0) << result.err;
  const auto object = readAll(out_.path("x.rawlog")).at(5).objects->objects.at(0);
  EXPECT_EQ(object.label, "office chair");
  EXPECT_NEAR(object.box.x1, 16, 1e-6);
}

TEST_F(QuadmapImport, SaysThatNamesOfClassesAreNotUsed)
{
  const auto result = run("tum IN -o OUT/x.rawlog --labels my.names");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("itself; --labels my.names is not used"), kNotFound) << result.err;
  std::filesystem::remove_all(recording_.files.path("detections"));
  const std::string note = run("tum IN -o OUT/x.rawlog --labels my.names").err;
  EXPECT_NE(note.find("no detections, "), kNotFound) << note;
  EXPECT_NE(note.find("; --labels my.names is not used"), kNotFound) << note;
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

TEST_F(QuadmapImport, NeverReplacesTheRecordingThatItReads)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog").status, 0);
  const auto before = readFile(out_.path("x.rawlog"));
  const auto result = run("rawlog OUT/x.rawlog -o OUT/x.rawlog --every 2");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("is the recording itself"), kNotFound) << result.err;
  EXPECT_TRUE(readFile(out_.path("x.rawlog")) == before);
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
  for (int i = 0; i < 8; ++i) records.push_back(sampleScan(kStart + 0.5 * i));
  for (int i = 0; i < 8; ++i) records.push_back(samplePose(kStart + 0.5 * i, {}));
  writeObjects(out_.path("x.rawlog"), records);
  const auto result = run("rawlog OUT/x.rawlog -o OUT/y.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("of 8 frames have no pose in "), kNotFound) << result.err;
  EXPECT_EQ(run("rawlog OUT/x.rawlog --check").status, 1) << "frames without a pose";
}

TEST_F(QuadmapImport, TakesEveryNthFrameAndOtherDetections)
{
  const TemporaryFolder detections;
  detections.write("f4.txt", "41 cup 0.5 1 1 9 9\n41 cup 0.5 2 2 9 9\n");
  const auto result =
      run("tum IN -o OUT/x.rawlog --every 2 --detections " + detections.folder().string());
  ASSERT_EQ(result.status, 0) << result.err;
  const auto frames = readAll(out_.path("x.rawlog"));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_NEAR(frames[1].time(), 100.2, 1e-6);
  EXPECT_FALSE(frames[1].objects);
  ASSERT_TRUE(frames[2].objects);
  EXPECT_EQ(frames[2].objects->objects.size(), 2u);
}

TEST_F(QuadmapImport, TellsWhichImagesHaveNoFileOfBoxes)
{
  const TemporaryFolder detections;
  const std::string arguments =
      "tum IN -o OUT/x.rawlog --detections " + detections.folder().string();
  detections.write("other.txt", "41 cup 0.5 1 1 9 9\n");
  expectFailure(run(arguments), "6 of 6 images have no result of the detector");
  EXPECT_EQ(out_.fileCount(), 0u);
  EXPECT_EQ(run(arguments + " --keep-going").status, 0);
  detections.write("f0.txt", "41 cup 0.5 1 1 9 9\n");
  const auto result = run(arguments);
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: 5 of 6 images"), kNotFound) << result.err;
  EXPECT_NE(result.err.find("that of the first would be " + detections.path("f1.txt")), kNotFound)
      << result.err;
}

TEST_F(QuadmapImport, WritesExternalImages)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog --external").status, 0);
  EXPECT_TRUE(std::filesystem::exists(out_.path("x_Images/camera_000005_depth.bin")));
  EXPECT_EQ(readAll(out_.path("x.rawlog")).size(), 6u);
}

TEST_F(QuadmapImport, SaysWhatIsMissingButNotNeeded)
{
  std::filesystem::remove(recording_.files.path("groundtruth.txt"));
  const auto result = run("tum IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("note: "), kNotFound);
  EXPECT_NE(result.err.find("no groundtruth.txt, hence no poses"), kNotFound) << result.err;
}

TEST_F(QuadmapImport, ChecksWithoutWriting)
{
  auto result = run("tum IN --check");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("no problem found"), kNotFound) << result.out;
  for (const char* file : {"rgb/f1.png", "rgb/f2.png", "rgb/f3.png", "rgb/f4.png", "depth/f5.png"})
    std::filesystem::remove(recording_.files.path(file));
  result = run("tum IN --check -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("missing file (5)"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("rgb/f3.png"), kNotFound) << "the first three are examples";
  EXPECT_EQ(result.out.find("rgb/f4.png"), kNotFound);
  EXPECT_EQ(out_.fileCount(), 0u);
}

TEST_F(QuadmapImport, ChecksWithTheLimitsAskedFor)
{
  EXPECT_EQ(run("tum IN --check --max-gap 0.05").status, 1);
  recording_.files.write(
      "groundtruth.txt", SampleRecording::pose(0, 0) + SampleRecording::pose(1, 0.4) +
                             SampleRecording::pose(2, 0.45) + SampleRecording::pose(3, 0.5) +
                             SampleRecording::pose(4, 0.55) + SampleRecording::pose(5, 0.6));
  auto result = run("tum IN --check");
  EXPECT_EQ(result.status, 0) << "4 m/s is less than ten times the median: " << result.out;
  recording_.files.write(
      "groundtruth.txt", SampleRecording::pose(0, 0) + SampleRecording::pose(1, 0.4) +
                             SampleRecording::pose(2, 0.41) + SampleRecording::pose(3, 0.42) +
                             SampleRecording::pose(4, 0.43) + SampleRecording::pose(5, 0.44));
  result = run("tum IN --check");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("pose jumps (1)"), kNotFound) << result.out;
  EXPECT_EQ(run("tum IN --check --max-speed 5").status, 0);
}

TEST_F(QuadmapImport, BadInputGivesOneLineAndNoOutput)
{
  const auto expect = [&](const std::string& file, const std::string& text, const std::string& part)
  {
    const auto good = readFile(recording_.files.path(file));
    if (text.empty())
      std::filesystem::remove(recording_.files.path(file));
    else
      recording_.files.write(file, text);
    expectFailure(run("tum IN -o OUT/x.rawlog"), part);
    EXPECT_EQ(out_.fileCount(), 0u);
    recording_.files.write(file, good);
  };
  expect("calibration.yaml", "", "calibration.yaml: no such file");
  expect("calibration.yaml", "%YAML:1.0\n---\nfx: 0.\nfy: 1.\n", "calibration.yaml: fx=0");
  expect("associations.txt", "1 2 3\n", "associations.txt:1: expected 4 columns");
  expect("rgb/f3.png", "", "rgb/f3.png: no such file");
  expect("depth/f3.png", "x", "depth/f3.png: cannot be read as an image");
  expect("detections/f3.txt", "1 cup 1 9 9 5 5\n", "detections/f3.txt: cup (x1=9 y1=9 x2=5 y2=5)");
  expect("groundtruth.txt", "1 2\n", "groundtruth.txt:1");
  expect(
      "associations.txt",
      SampleRecording::line(0, 2) + SampleRecording::line(1, 1) + SampleRecording::line(2, 3),
      "associations.txt:2: time 1.000000 s is not after the frame before");
  expectFailure(run("tum OUT/none -o OUT/x.rawlog"), "none: no such folder");
  expectFailure(run("tum IN -o OUT/x.rawlog --detections OUT/none"), "none: no such folder");
}

TEST_F(QuadmapImport, KeepsGoingAndSaysWhatItDropped)
{
  std::filesystem::remove(recording_.files.path("rgb/f3.png"));
  recording_.files.write("detections/f1.txt", "1 cup 1 9 9 5 5\n1 cup 1 1 1 5 5\n");
  const auto result = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("dropped: "), kNotFound);
  EXPECT_NE(result.err.find("rgb/f3.png: no such file"), kNotFound) << result.err;
  EXPECT_NE(result.err.find("is inverted"), kNotFound) << result.err;
  EXPECT_NE(result.out.find("(2 things dropped)"), kNotFound) << result.out;
  const auto frames = readAll(out_.path("x.rawlog"));
  ASSERT_EQ(frames.size(), 5u);
  ASSERT_TRUE(frames[1].objects);
  EXPECT_EQ(frames[1].objects->objects.size(), 1u);
}

TEST_F(QuadmapImport, KeepGoingWithoutAnyFrameIsAFailure)
{
  std::filesystem::remove_all(recording_.files.path("rgb"));
  const auto result = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("no frame could be imported"), kNotFound) << result.err;
  EXPECT_EQ(out_.fileCount(), 0u);
}

TEST_F(QuadmapImport, UnwritableOutput)
{
  expectFailure(run("tum IN -o OUT/no/x.rawlog"), "no/x.rawlog");
  std::filesystem::create_directory(out_.path("x.rawlog"));
  expectFailure(run("tum IN -o OUT/x.rawlog"), "x.rawlog");
  EXPECT_EQ(out_.fileCount(), 1u);
}

TEST_F(QuadmapImport, FullDiskLeavesNothing)
{
  for (const std::string option : {"", " --external"})
  {
    ProgramResult result;
    {
      const FileSizeLimit full(400);  // the program inherits it
      result = run("tum IN -o OUT/x.rawlog" + option);
    }
    expectFailure(
        result, option.empty() ? "x.rawlog: cannot be written: " : "x_Images/camera_000000");
    EXPECT_EQ(out_.fileCount(), 0u);
  }
}

TEST_F(QuadmapImport, WrongUsageIsStatus2)
{
  for (const char* arguments :
       {"", "tum", "tum IN", "tom IN -o OUT/x.rawlog", "tum IN -o OUT/x.rawlog --every 0",
        "tum IN -o OUT/x.rawlog --every -1", "tum IN -o OUT/x.rawlog --every two",
        "tum IN -o OUT/x.rawlog --poses-as truth", "tum IN -o OUT/x.rawlog --evry 2", "tum IN -o",
        "tum IN --check --max-gap -1", "tum IN --check --max-speed 0",
        "openni2 live -o OUT/x.rawlog --labels IN/x",
        "openni2 live -o OUT/x.rawlog --images-anywhere",
        "rawlog x.rawlog -o OUT/x.rawlog --trajectory IN/groundtruth.txt --poses-as none"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(out_.fileCount(), 0u);
  }
}

TEST_F(QuadmapImport, ShowsHelpAndVersion)
{
  const auto help = run("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* option :
       {"--output", "--check", "--external", "--poses-as", "--detections", "--labels", "--camera"})
    EXPECT_NE(help.out.find(option), kNotFound) << option;
  const auto version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.find("quadmap-import "), 0u) << version.out;
}

TEST_F(QuadmapImport, ImportsARealRecording)
{
  const auto cabinet = testData("tum_fr3_cabinet");
  if (cabinet.empty()) GTEST_SKIP() << "the recordings are not here";
  const auto result = run("tum " + cabinet + " -o OUT/cabinet.rawlog");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto frames = readAll(out_.path("cabinet.rawlog"));
  ASSERT_EQ(frames.size(), 58u);
  std::size_t boxes = 0;
  for (const auto& frame : frames)
  {
    EXPECT_TRUE(frame.T_odom_robot);
    ASSERT_TRUE(frame.objects);
    boxes += frame.objects->objects.size();
  }
  EXPECT_EQ(boxes, 51u);
}
