#include <gtest/gtest.h>

#include "RedCorner.h"
#include "RunProgram.h"
#include "quadmap/obs/FrameAgreement.h"

using namespace quadmap;

namespace
{
class QuadmapDetect : public ::testing::Test
{
 protected:
  /** Runs the program with the model of TinyDetector. */
  ProgramResult run(const std::string& arguments) const
  {
    return runProgram("quadmap-detect", arguments + " --model '" + tiny_.model() + "'");
  }
  std::string writeRecording(int frames = 5) const
  {
    return writeScans(folder_.path("x.rawlog"), redCornerScans(frames));
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path(name)); }

  TinyDetector tiny_;
  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapDetect, WritesBoxesWhereTheOtherProgramsLook)
{
  const auto rawlog = writeRecording();
  const auto result = run(rawlog);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "") << "no bar without a terminal";
  EXPECT_NE(result.out.find("x.objects.rawlog: 5 frames, 5 boxes, "), kNotFound) << result.out;
  EXPECT_NE(result.out.find("frames/s"), kNotFound) << result.out;
  const auto frames = readAll(rawlog);
  ASSERT_EQ(frames.size(), 5u);
  for (const auto& frame : frames)
  {
    ASSERT_TRUE(frame.objects);
    ASSERT_EQ(frame.objects->objects.size(), 1u);
    EXPECT_EQ(frame.objects->objects[0].label, "chair");
    EXPECT_NEAR(frame.objects->objects[0].box.x2, 12, 0.5);
    EXPECT_NEAR(frame.objects->objects[0].box.y2, 9, 0.5);
  }
}

TEST_F(QuadmapDetect, TheSameImagesGiveTheSameBytes)
{
  const auto rawlog = writeRecording();
  ASSERT_EQ(run(rawlog).status, 0);
  const auto first = readFile(folder_.path("x.objects.rawlog"));
  ASSERT_EQ(run(rawlog).status, 0);
  EXPECT_EQ(readFile(folder_.path("x.objects.rawlog")), first);
}

TEST_F(QuadmapDetect, ReplacesEarlierBoxesWithoutReadingThem)
{
  const auto rawlog = writeRecording();
  folder_.write("x.objects.rawlog", "nonsense");
  ASSERT_EQ(run(rawlog).status, 0);
  EXPECT_TRUE(readAll(rawlog).at(0).objects);
  ASSERT_EQ(run(rawlog + " -o " + folder_.path("other.rawlog")).status, 0);
  EXPECT_EQ(readFile(folder_.path("other.rawlog")), readFile(folder_.path("x.objects.rawlog")));
}

TEST_F(QuadmapDetect, LooksAtImagesThatAreUpsideDown)
{
  auto scans = redCornerScans(2);
  for (auto& scan : scans)
  {
    scan->cameraParams.setIntrinsicParamsFromValues(60, -62, 31.5, 23.5);
    scan->cameraParamsIntensity = scan->cameraParams;
  }
  const auto rawlog = writeScans(folder_.path("x.rawlog"), scans);
  ASSERT_EQ(run(rawlog + " --draw " + folder_.path("pictures")).status, 0);
  const auto frames = readAll(rawlog);  // which checks that boxes and scans agree
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_TRUE(frames[1].isTurned);
  ASSERT_TRUE(frames[1].objects);
  EXPECT_NEAR(frames[1].objects->objects.at(0).box.y1, kRows - 1 - 9, 0.5);
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile(folder_.path("pictures/frame-000000.jpg")));
  const auto scale = static_cast<unsigned>(picture.getWidth() / kColumns);
  const auto* bgr = picture.ptr<std::uint8_t>(2 * scale, 4 * scale);
  EXPECT_GT(bgr[2], bgr[1]) << "drawn as it was recorded, red at the upper left";
}

TEST_F(QuadmapDetect, DrawsPictures)
{
  const auto rawlog = writeRecording(3);
  ASSERT_EQ(run(rawlog + " --draw " + folder_.path("a/b")).status, 0);
  for (const char* name : {"a/b/frame-000000.jpg", "a/b/frame-000002.jpg"})
  {
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(folder_.path(name))) << name;
    EXPECT_GT(picture.getWidth(), 1000u);
  }
  EXPECT_FALSE(exists("a/b/frame-000003.jpg"));
}

TEST_F(QuadmapDetect, WritesTheBoxesIntoTheNewFolderOfThePictures)
{
  const auto rawlog = writeRecording(3);
  const std::string arguments =
      " --draw " + folder_.path("new") + " -o " + folder_.path("new/b.rawlog");
  EXPECT_EQ(run(folder_.write("bad.rawlog", "nonsense") + arguments).status, 1);
  EXPECT_FALSE(exists("new")) << "nothing of a run that fails";
  const auto result = run(rawlog + arguments);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(exists("new/b.rawlog"));
  EXPECT_TRUE(exists("new/frame-000002.jpg"));
}

TEST_F(QuadmapDetect, ListsTheModels)
{
  ::setenv("QUADMAP_MODELS", folder_.folder().c_str(), 1);
  folder_.write("nanodet.onnx", "an error page");
  folder_.write("own.ini", "[detector]\nweights = own.onnx\n");
  folder_.write("own.onnx", "x");
  const auto result = runProgram("quadmap-detect", "--list");
  ::unsetenv("QUADMAP_MODELS");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find(folder_.folder().string()), kNotFound) << result.out;
  std::istringstream lines(result.out);
  int curl = 0;
  for (std::string line; std::getline(lines, line);)
  {
    EXPECT_EQ(line.find(" installed ") != kNotFound, line.find("own ") == 0) << line;
    EXPECT_EQ(line.find(" wrong ") != kNotFound, line.find("nanodet-m ") == 0) << line;
    curl += line.find("    mkdir -p '" + folder_.folder().string() + "' && curl -fL ") == 0;
    EXPECT_EQ(line.find("ultralytics"), kNotFound);
  }
  EXPECT_GE(curl, 4);
}

TEST_F(QuadmapDetect, NamesWhatIsWrongInOneLine)
{
  const auto rawlog = writeRecording();
  folder_.write("x.objects.rawlog", "as before");
  const auto expectError = [&](const ProgramResult& result, const std::string& part)
  {
    EXPECT_EQ(result.status, 1) << part;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_EQ(result.err.find("quadmap-detect: "), 0u) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << result.err;
    EXPECT_EQ(readFile(folder_.path("x.objects.rawlog")), "as before");
    EXPECT_EQ(folder_.fileCount(), 2u);
  };
  expectError(run("/nonexistent.rawlog"), "/nonexistent.rawlog");
  expectError(run(rawlog + " -o /nonexistent/boxes"), "/nonexistent/boxes");
  expectError(run(rawlog + " --sensor left"), "no usable RGB-D images of a sensor \"left\"");
  expectError(
      runProgram("quadmap-detect", rawlog + " --model nosuch"), "nosuch: is no known model");
  expectError(
      runProgram("quadmap-detect", rawlog + " --model chairs.onnx"),
      "chairs.onnx: there is no such file");
  tiny_.folder.write("tiny.weights", "");
  expectError(run(rawlog), "tiny.weights: is empty");
}

TEST_F(QuadmapDetect, NeverReplacesTheRecordingByItsBoxes)
{
  const auto rawlog = writeRecording();
  const auto before = readFile(rawlog);
  std::filesystem::create_symlink(rawlog, folder_.path("link.rawlog"));
  for (const auto& output : {rawlog, folder_.path("link.rawlog")})
  {
    const auto result = run(rawlog + " -o " + output);
    EXPECT_EQ(result.status, 2) << output;
    EXPECT_NE(result.err.find("is the recording itself"), kNotFound) << result.err;
    EXPECT_TRUE(readFile(rawlog) == before) << output;
  }
  const auto model = run(rawlog + " -o '" + tiny_.model() + "'");
  EXPECT_EQ(model.status, 2);
  EXPECT_NE(model.err.find("which is read and stays as it is"), kNotFound) << model.err;
}

TEST_F(QuadmapDetect, TellsOfImagesWithoutColour)
{
  auto scans = redCornerScans(3);
  scans[1]->hasIntensityImage = false;
  auto rawlog = writeScans(folder_.path("x.rawlog"), scans);
  auto result = run(rawlog);
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("1 of 3 images have no colour"), kNotFound) << result.err;
  EXPECT_FALSE(readAll(rawlog).at(1).objects) << "nobody looked";
  for (auto& scan : scans) scan->hasIntensityImage = false;
  rawlog = writeScans(folder_.path("y.rawlog"), scans);
  result = run(rawlog);
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("none of its 3 images has colour"), kNotFound) << result.err;
  EXPECT_FALSE(exists("y.objects.rawlog"));
}

TEST_F(QuadmapDetect, KeepsGoingWhenAsked)
{
  const auto rawlog = writeRecording(6);
  const auto whole = readFile(rawlog);
  folder_.write("x.rawlog", whole.substr(0, whole.size() * 2 / 3));
  EXPECT_EQ(run(rawlog).status, 1);
  EXPECT_FALSE(exists("x.objects.rawlog"));
  const auto result = run(rawlog + " --keep-going");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("left out: "), kNotFound) << result.err;
  EXPECT_TRUE(exists("x.objects.rawlog"));
}

TEST_F(QuadmapDetect, AnswersWrongUsageWithStatus2AndOneLine)
{
  for (const char* arguments : {"", "x.rawlog", "--model m", "x.rawlog --list --model m", "--lsit"})
  {
    const auto result = runProgram("quadmap-detect", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
  }
  const auto expectSuggestion = [](const std::string& option, const std::string& suggestion)
  {
    EXPECT_EQ(
        runProgram("quadmap-detect", "x.rawlog " + option).err,
        "quadmap-detect: unknown option " + option + suggestion + " (see quadmap-detect --help)\n");
  };
  expectSuggestion("--lsit", "; did you mean --list?");
  expectSuggestion("-modle", "; did you mean --model?");
  expectSuggestion("--MODEL", "; did you mean --model?");
  expectSuggestion("--ouptut=/tmp/some/where.rawlog", "; did you mean --output?");
  expectSuggestion("--xyzzy", "");
  expectSuggestion("---", "");
}

TEST_F(QuadmapDetect, SaysThatValuesOfOptionsStandBehindABlank)
{
  const std::pair<std::string, std::string> complaints[] = {
      {"--output=/tmp/some/where.rawlog", "--output takes its value after a blank"},
      {                           "-o=x",       "-o takes its value after a blank"},
      {                 "--keep-going=1",            "--keep-going takes no value"}
  };
  for (const auto& [option, complaint] : complaints)
    EXPECT_EQ(
        runProgram("quadmap-detect", "x.rawlog " + option).err,
        "quadmap-detect: " + option + ": " + complaint + " (see quadmap-detect --help)\n");
}
