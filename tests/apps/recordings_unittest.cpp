#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "../obs/TestData.h"
#include "RunProgram.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/obs/ObjectList.h"

using namespace quadmap;
using nlohmann::json;

// The whole chain of programs on whole recordings. Bounds are about 1.5 times the errors that
// doc/benchmarks.md shows for them.
namespace
{
std::string quoted(const std::string& path) { return "'" + path + "'"; }

void expectSuccess(const std::string& program, const std::string& arguments)
{
  const auto result = runProgram(program, arguments);
  ASSERT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
}

/** Imports a recording with its poses as odometry and maps it. \param boxes A folder in it. */
void importAndMap(
    const std::string& recording,
    const TemporaryFolder& folder,
    const std::string& boxes = "detections")
{
  const auto rawlog = quoted(folder.path("x.rawlog"));
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-import", "tum " + quoted(recording) + " --detections " +
                            quoted(recording + "/" + boxes) + " -o " + rawlog));
  ASSERT_NO_FATAL_FAILURE(
      expectSuccess("quadmap-slam", rawlog + " -o " + quoted(folder.path("out"))));
}

json figures(const TemporaryFolder& folder, const std::string& arguments)
{
  const auto file = folder.path("figures.json");
  expectSuccess(
      "quadmap-evaluate", quoted(folder.path("out")) + " --json " + quoted(file) + " " + arguments);
  return json::parse(readFile(file));
}

/** The figures of a recording whose truth is in the frame of its true trajectory. */
json figuresByTrajectory(const std::string& recording, const TemporaryFolder& folder)
{
  return figures(
      folder, "--objects " + quoted(recording + "/objects_gt.json") + " --trajectory " +
                  quoted(recording + "/groundtruth.txt"));
}

json report(const TemporaryFolder& folder)
{
  return json::parse(readFile(folder.path("out/report.json")));
}

/** Makes a folder with the second half of a recording, whose images stay where they are. */
std::string secondHalf(const std::string& recording, const TemporaryFolder& folder)
{
  namespace fs = std::filesystem;
  const std::string half = folder.path("half");
  fs::create_directory(half);
  for (const char* images : {"rgb", "depth"})
    fs::create_directory_symlink(recording + "/" + images, half + "/" + images);
  for (const char* file : {"calibration.yaml", "groundtruth.txt"})
    fs::copy_file(recording + "/" + file, half + "/" + file);
  std::istringstream all(readFile(recording + "/associations.txt"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(all, line);) lines.push_back(line + "\n");
  std::string rest;
  for (std::size_t i = lines.size() / 2; i < lines.size(); ++i) rest += lines[i];
  writeTextFile(half + "/associations.txt", rest);
  return half;
}
/** What both detectors reach in the kitchen. \param mostTrans [m] */
void expectTheKitchen(const json& figures, double mostTrans)
{
  const json& f = figures["objects"];
  EXPECT_GE(f["matched"], 10) << "no detector boxed the other four at least five times";
  EXPECT_LE(f["estimated"], f["matched"].get<int>() + 1);
  EXPECT_LE(f["trans_m"], mostTrans);
  EXPECT_GE(f["shape_iou"], 0.68);
  for (const auto& match : figures["matches"])
  {
    if (match["label"] != "tvmonitor") continue;
    EXPECT_GE(match["shape_iou"], 0.5) << match["truth_id"];
  }
}
}  // namespace

TEST(Recordings, BundledHome)
{
  const std::string home = QUADMAP_SOURCE_DIR "/rawlogs/home";
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-slam",
      quoted(home + ".rawlog") + " --odometry ground-truth -o " + quoted(folder.path("out"))));
  const json f = figures(
      folder, "--objects " + quoted(home + ".objects.gt.json") + " --trajectory " +
                  quoted(home + ".groundtruth.tum"));
  EXPECT_LT(f["trajectory"]["ate_rmse_m"], 1e-3) << "the true poses were given";
  EXPECT_EQ(f["objects"]["f1"], 1.0);
  EXPECT_LE(f["objects"]["trans_m"], 0.02);
  EXPECT_LE(f["objects"]["rot_deg"], 0.5);
  EXPECT_GE(f["objects"]["shape_iou"], 0.87);
}

TEST(Recordings, CabinetOfTumFr3)
{
  const auto recording = testData("tum_fr3_cabinet");
  if (recording.empty()) GTEST_SKIP() << "recording tum_fr3_cabinet is not there";
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(importAndMap(recording, folder));
  const json f = figures(folder, "--in-place --objects " + quoted(recording + "/objects_gt.json"));
  EXPECT_EQ(f["objects"]["estimated"], 1);
  EXPECT_EQ(f["objects"]["matched"], 1);
  EXPECT_LE(f["objects"]["trans_m"], 0.017);
  EXPECT_LE(f["objects"]["rot_deg"], 0.5);
  EXPECT_GE(f["objects"]["shape_iou"], 0.90);
}

TEST(Recordings, Kitchen)
{
  const auto recording = testData("kitchen_a");
  if (recording.empty()) GTEST_SKIP() << "recording kitchen_a is not there";
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(importAndMap(recording, folder));
  std::map<std::string, int> counts;
  const auto objects = readObjectsJson(folder.path("out/objects.json"));
  for (const auto& object : objects) ++counts[object.label];
  EXPECT_EQ(counts["dining table"], 1);
  EXPECT_EQ(counts["cup"], 2);
  EXPECT_GE(counts["chair"], 3);
  EXPECT_GE(counts["tv"], 1);
  expectTheKitchen(figuresByTrajectory(recording, folder), 0.05);
  // Some ten times the figure of doc/benchmarks.md: machines differ, and share their cores.
  EXPECT_LE(report(folder)["timing"]["modules"]["perception"]["cpu_mean_ms"], 60.0);
}

TEST(Recordings, KitchenWithAnotherDetector)
{
  const auto recording = testData("kitchen_a");
  if (recording.empty()) GTEST_SKIP() << "recording kitchen_a is not there";
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(importAndMap(recording, folder, "detections_yolov8n"));
  expectTheKitchen(figuresByTrajectory(recording, folder), 0.05);
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-slam",
      quoted(folder.path("x.rawlog")) + " --odometry visual -o " + quoted(folder.path("out"))));
  expectTheKitchen(figuresByTrajectory(recording, folder), 0.07);
}

// Its second half shows no floor, and the camera is not held level.
TEST(Recordings, KitchenWithoutItsFloor)
{
  const auto recording = testData("kitchen_a");
  if (recording.empty()) GTEST_SKIP() << "recording kitchen_a is not there";
  const TemporaryFolder folder;
  const auto half = secondHalf(recording, folder);
  ASSERT_NO_FATAL_FAILURE(expectSuccess(
      "quadmap-import", "tum " + quoted(half) + " --images-anywhere --detections " +
                            quoted(recording + "/detections_yolov8n") + " -o " +
                            quoted(folder.path("x.rawlog"))));
  for (const std::string poses : {"rawlog", "visual"})
  {
    ASSERT_NO_FATAL_FAILURE(expectSuccess(
        "quadmap-slam", quoted(folder.path("x.rawlog")) + " --odometry " + poses + " -o " +
                            quoted(folder.path("out"))));
    const json f = figuresByTrajectory(recording, folder)["objects"];
    EXPECT_GE(f["matched"], 9) << poses;
    EXPECT_LE(f["estimated"], f["matched"].get<int>() + 1) << poses;
    EXPECT_LE(f["trans_m"], poses == "visual" ? 0.09 : 0.05) << poses;
    EXPECT_LE(f["rot_deg"], 5.0) << poses;
    EXPECT_GE(f["shape_iou"], 0.62) << poses;
  }
  EXPECT_EQ(report(folder)["visual_odometry"]["up"], "horizontal and vertical surfaces");
}

TEST(Recordings, DeskOfTumFr2FromOneSide)
{
  const auto recording = testData("tum_fr2_desk");
  if (recording.empty()) GTEST_SKIP() << "recording tum_fr2_desk is not there";
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(importAndMap(recording, folder));
  const json all = figuresByTrajectory(recording, folder);
  const json f = all["objects"];
  EXPECT_GE(f["matched"], 4);
  EXPECT_EQ(f["estimated"], f["matched"]) << "the plant, cut by the image, is right or not there";
  EXPECT_GE(f["shape_iou"], 0.50);
  for (const auto& match : all["matches"])
  {
    if (match["truth_id"] == "plant_0") continue;  // the images show a part of it
    EXPECT_LE(match["trans_m"], 0.07) << match["truth_id"];
  }
}

TEST(Recordings, SampleRawlogsOfMrpt)
{
  const auto samples = testData("mrpt");
  if (samples.empty()) GTEST_SKIP() << "the rawlogs of MRPT are not there";
  const TemporaryFolder folder;
  unsigned withoutImages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(samples))
  {
    if (entry.path().extension() != ".rawlog") continue;
    const auto out = quoted(folder.path("out"));
    const auto result =
        runProgram("quadmap-slam", quoted(entry.path().string()) + " -v error -o " + out);
    EXPECT_EQ(result.status, 1) << entry.path();
    EXPECT_EQ(result.err.find("quadmap-slam: " + entry.path().string() + ": no "), 0u)
        << result.err;
    if (entry.path().filename() == "tests_rgbd.rawlog")
      EXPECT_NE(result.err.find("no object boxes"), std::string::npos) << result.err;
    else
      withoutImages += result.err.find("no usable RGB-D images; it has ") != std::string::npos;
    EXPECT_FALSE(std::filesystem::exists(folder.path("out"))) << "nothing is left behind";
  }
  EXPECT_GE(withoutImages, 3u);
}
