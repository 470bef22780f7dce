#include <gtest/gtest.h>

#include <filesystem>

#include "../obs/FileSizeLimit.h"
#include "../sensors/SampleRawlog.h"
#include "FolderContents.h"
#include "ImportFixture.h"

using namespace quadmap;

TEST_F(QuadmapImport, RefusesResultsOfOtherImages)
{
  const std::string file = recording_.files.write(
      "r.json", R"([{"image_id": "other", "category_id": 0, "bbox": [1, 2, 3, 4]}])");
  const std::string boxes =
      " --detections " + file + " --labels " + recording_.files.write("my.names", "tv\n");
  const std::string what = "none of its boxes is of an image of ";
  expectImportFailure(run("tum IN -o OUT/x.rawlog" + boxes), what);
  const auto kept = run("tum IN -o OUT/x.rawlog --keep-going" + boxes);
  EXPECT_EQ(kept.status, 0);
  EXPECT_NE(kept.err.find("warning: "), kNotFound) << kept.err;
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

TEST_F(QuadmapImport, NeverReplacesTheBoxesOfTheRecordingThatItReads)
{
  ASSERT_EQ(run("tum IN -o OUT/x.rawlog").status, 0);
  std::filesystem::copy_file(out_.path("x.rawlog"), out_.path("x"));
  std::filesystem::copy_file(recording_.files.path("groundtruth.txt"), out_.path("gt.tum"));
  const auto before = contentsOf(out_.folder());
  for (const auto& [call, part] :
       {std::pair("OUT/x.rawlog -o OUT/x.objects.rawlog", "has the boxes of the recording"),
        std::pair("OUT/x.rawlog -o OUT/./x.objects.rawlog", "has the boxes of the recording"),
        std::pair("OUT/x.objects.rawlog -o OUT/x.rawlog", "would replace the recording itself"),
        std::pair("OUT/x -o OUT/x.rawlog", "would replace those of the recording"),
        std::pair("OUT/x.rawlog --trajectory OUT/gt.tum -o OUT/gt.tum", "which is read and stays")})
  {
    const auto result = run("rawlog " + std::string(call));
    EXPECT_EQ(result.status, 2) << call;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << result.err;
  }
  EXPECT_TRUE(contentsOf(out_.folder()) == before);
}

TEST_F(QuadmapImport, NeverReplacesAFileOfTheFolderThatItReads)
{
  const auto before = contentsOf(recording_.files.folder());
  for (const char* file :
       {"groundtruth.txt", "./associations.txt", "detections/../rgb/../groundtruth.txt"})
  {
    const auto result = run(std::string("tum IN -o IN/") + file);
    EXPECT_EQ(result.status, 2) << file;
    EXPECT_NE(result.err.find("is a file of the recording"), kNotFound) << result.err;
  }
  EXPECT_TRUE(contentsOf(recording_.files.folder()) == before);
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
    expectImportFailure(run("tum IN -o OUT/x.rawlog"), part);
    EXPECT_EQ(out_.fileCount(), 0u);
    recording_.files.write(file, good);
  };
  expect("calibration.yaml", "", "calibration.yaml: no such file");
  expect("calibration.yaml", "%YAML:1.0\n---\nfx: 0.\nfy: 1.\n", "calibration.yaml: fx=0");
  expect("associations.txt", "1 2 3\n", "associations.txt:1: expected 4 columns");
  expect("rgb/f3.png", "", "rgb/f3.png: no such file");
  expect("depth/f3.png", "x", "depth/f3.png: cannot be read as an image");
  expect(
      "detections/f3.txt", "1 cup 1 -1e300 -1e300 1e300 1e300\n",
      "detections/f3.txt:1: cup (x1=-1e+300 y1=-1e+300 x2=1e+300 y2=1e+300) reaches far outside");
  expect(
      "detections/f3.txt", "1 cup 1 9 9 5 5\n", "detections/f3.txt:1: cup (x1=9 y1=9 x2=5 y2=5)");
  expect("groundtruth.txt", "1 2\n", "groundtruth.txt:1");
  expect(
      "associations.txt",
      SampleRecording::line(0, 2) + SampleRecording::line(1, 1) + SampleRecording::line(2, 3),
      "associations.txt:2: time 1.000000 s is not after the frame before");
  expectImportFailure(run("tum OUT/none -o OUT/x.rawlog"), "none: no such folder");
  expectImportFailure(run("tum IN -o OUT/x.rawlog --detections OUT/none"), "none: no such folder");
}

TEST_F(QuadmapImport, KeepsGoingAndSaysWhatItDropped)
{
  std::filesystem::remove(recording_.files.path("rgb/f3.png"));
  recording_.files.write("detections/f1.txt", "\n1 cup 1 1 1 5 5\n1 cup 1 9 9 5 5\n");
  const auto result = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("dropped: "), kNotFound);
  EXPECT_NE(result.err.find("rgb/f3.png: no such file"), kNotFound) << result.err;
  EXPECT_NE(result.err.find("f1.txt:3: cup (x1=9 y1=9 x2=5 y2=5) is inverted"), kNotFound)
      << result.err;
  EXPECT_NE(result.out.find("(2 things dropped)"), kNotFound) << result.out;
  const auto frames = readAll(out_.path("x.rawlog"));
  ASSERT_EQ(frames.size(), 5u);
  ASSERT_TRUE(frames[1].objects);
  EXPECT_EQ(frames[1].objects->objects.size(), 1u);
}

TEST_F(QuadmapImport, OneBadLineLosesOneFrameOrPose)
{
  const std::string list = readFile(recording_.files.path("associations.txt")),
                    poses = readFile(recording_.files.path("groundtruth.txt"));
  recording_.files.write("associations.txt", "nonsense\n" + list);
  recording_.files.write("groundtruth.txt", poses + "nonsense\n");
  const auto result = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* line : {"associations.txt:1: expected 4", "groundtruth.txt:7: expected 8"})
    EXPECT_NE(result.err.find(line), kNotFound) << result.err;
  EXPECT_NE(result.out.find("6 frames, 6 poses as odometry"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("(2 things dropped)"), kNotFound) << result.out;
  const auto checked = run("tum IN --check");
  EXPECT_EQ(checked.status, 1);
  for (const char* kind : {"list (1)\n", "pose (1)\n"})
    EXPECT_NE(checked.out.find(kind), kNotFound) << checked.out;
  expectImportFailure(run("tum IN -o OUT/y.rawlog"), "associations.txt:1: expected 4 columns");
  recording_.files.write("associations.txt", list);
  expectImportFailure(run("tum IN -o OUT/y.rawlog"), "groundtruth.txt:7: expected 8 columns");
}

TEST_F(QuadmapImport, AnImageListedTwiceIsTakenOnce)
{
  const std::string list = readFile(recording_.files.path("associations.txt"));
  recording_.files.write("associations.txt", list + "100.6 rgb/f5.png 100.6 depth/f5.png\n");
  const std::string what = "associations.txt:7: rgb/f5.png stands in line 6 as well";
  expectImportFailure(run("tum IN -o OUT/x.rawlog"), what);
  const auto kept = run("tum IN -o OUT/x.rawlog --keep-going");
  EXPECT_EQ(kept.status, 0) << kept.err;
  EXPECT_NE(kept.err.find("dropped: "), kNotFound) << kept.err;
  EXPECT_NE(kept.err.find(what), kNotFound) << kept.err;
  EXPECT_NE(kept.out.find("6 frames"), kNotFound) << kept.out;
}

TEST_F(QuadmapImport, OneWrongTimeLosesOneFrame)
{
  for (const int wrong : {0, 2})
  {
    std::string list;
    for (int i = 0; i < SampleRecording::kFrames; ++i)
      list += SampleRecording::line(
          i, i == wrong ? 1e9 : SampleRecording::kStart + SampleRecording::kInterval * i);
    recording_.files.write("associations.txt", list);
    const auto result = run("tum IN -o OUT/x.rawlog --keep-going");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(
        result.err.find(mrpt::format(
            "associations.txt:%d: time 1000000000.000000 s is after those of the frames behind it",
            wrong + 1)),
        kNotFound)
        << result.err;
    EXPECT_EQ(readAll(out_.path("x.rawlog")).size(), std::size_t{SampleRecording::kFrames - 1});
    std::filesystem::remove(out_.path("x.rawlog"));
  }
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
  expectImportFailure(run("tum IN -o OUT/no/x.rawlog"), "no/x.rawlog");
  std::filesystem::create_directory(out_.path("x.rawlog"));
  expectImportFailure(run("tum IN -o OUT/x.rawlog"), "x.rawlog");
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
    expectImportFailure(result, option.empty() ? "x.rawlog: " : "x_Images/camera_000000");
    EXPECT_NE(result.err.find(": cannot be written: File too large"), kNotFound) << result.err;
    EXPECT_EQ(out_.fileCount(), 0u);
  }
}

TEST_F(QuadmapImport, WrongUsageIsStatus2)
{
  for (const char* arguments :
       {"", "tum", "tum IN", "tom IN -o OUT/x.rawlog", "tum IN -o OUT/x.rawlog --every 0",
        "tum IN -o OUT/x.rawlog --every -1", "tum IN -o OUT/x.rawlog --every two",
        "tum IN -o OUT/x.rawlog --every ''", "tum IN -o OUT/x.rawlog --poses-as truth",
        "tum IN -o OUT/x.rawlog --evry 2", "tum IN -o", "tum IN --check --max-gap -1",
        "tum IN --check --max-speed 0", "openni2 live -o OUT/x.rawlog --labels IN/x",
        "openni2 live -o OUT/x.rawlog --images-anywhere",
        "rawlog x.rawlog -o OUT/x.rawlog --trajectory IN/groundtruth.txt --poses-as none"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(out_.fileCount(), 0u);
  }
}

TEST_F(QuadmapImport, AnEmptyTextIsNotTakenForNone)
{
  const std::pair<const char*, const char*> cases[] = {
      {"tum IN -o OUT/x.rawlog --detections ''", "--detections: must not be empty (see "},
      {    "tum IN -o OUT/x.rawlog --camera ''",     "--camera: must not be empty (see "},
      {                          "tum IN -o ''",     "--output: must not be empty (see "},
      {                "tum '' -o OUT/x.rawlog",       "SOURCE: must not be empty (see "},
  };
  for (const auto& [arguments, what] : cases)
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(what), kNotFound) << result.err;
    EXPECT_EQ(out_.fileCount(), 0u);
  }
}
