#include <gtest/gtest.h>

#include <filesystem>

#include "../obs/TestData.h"
#include "../sensors/SampleRawlog.h"
#include "ImportFixture.h"

using namespace quadmap;

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
  expectImportFailure(run("auto OUT -o OUT/y.rawlog"), "tum has associations.txt");
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
  expectImportFailure(
      run("tum IN -o OUT/y.rawlog --camera kinekt"), "kinekt: no such camera; known are");
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
  expectImportFailure(run(arguments), "6 of 6 images have no result of the detector");
  EXPECT_EQ(out_.fileCount(), 0u);
  EXPECT_EQ(run(arguments + " --keep-going").status, 0);
  detections.write("f0.txt", "41 cup 0.5 1 1 9 9\n");
  const auto result = run(arguments);
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: 5 of 6 images"), kNotFound) << result.err;
  EXPECT_NE(result.err.find("that of the first would be " + detections.path("f1.txt")), kNotFound)
      << result.err;
}

TEST_F(QuadmapImport, KeepsTheSurestBoxesOfACrowdedImage)
{
  // 400 boxes of image f2, of which the score of the k-th is k/1000; the first 120 are cups.
  std::string lines, results;
  for (int k = 0; k < 400; ++k)
  {
    const bool isCup = k < 120;
    lines += mrpt::format("1 %s %.3f 1 1 9 9\n", isCup ? "cup" : "book", k * 1e-3);
    results += mrpt::format(
        R"(%s{"image_id": "f2", "category_id": %d, "bbox": [1, 1, 8, 8], "score": %.3f})",
        k == 0 ? "" : ",", isCup ? 47 : 84, k * 1e-3);
  }
  recording_.files.write("detections/f2.txt", lines);
  const std::string coco = recording_.files.write("r.json", "[" + results + "]");
  const std::string detections = recording_.files.path("detections");
  for (const auto& [place, image] :
       {std::pair(detections, detections + "/f2.txt"), std::pair(coco, coco + ": image f2")})
  {
    const auto result = run("tum IN -o OUT/x.rawlog --detections " + place);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(
        result.err.find(
            "quadmap-import: warning: 1 of 6 images have more than 300 boxes, of which those with "
            "the highest scores are kept; the first is " +
            image + " (400 boxes)\n"),
        kNotFound)
        << result.err;
    RawlogSource source(out_.path("x.rawlog"), {});
    std::size_t cups = 0, all = 0;
    while (const auto frame = source.next())
      for (const auto& object : frame->objects->objects)
      {
        ++all;
        cups += object.label == "cup" ? 1 : 0;
      }
    EXPECT_EQ(all, place == coco ? 300u : 305u);
    EXPECT_EQ(cups, 20u) << "of scores from 0.1 on";
  }
}

TEST_F(QuadmapImport, TellsWhichImagesHaveNoPartner)
{
  std::filesystem::remove(recording_.files.path("associations.txt"));
  for (const char* image : {"depth/f2.png", "rgb/f1.png"})
    std::filesystem::remove(recording_.files.path(image));
  const auto result = run("icl IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string what =
      "warning: left out: 2 images without a partner (colour or depth), the "
      "first is " +
      recording_.files.path("rgb/f2.png\n");
  EXPECT_NE(result.err.find(what), kNotFound) << result.err;
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
