#include <gtest/gtest.h>
#include <mrpt/core/format.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <filesystem>

#include "../maps/SyntheticScene.h"
#include "../obs/TemporaryFolder.h"
#include "../sensors/SampleRawlog.h"
#include "Fuzz.h"
#include "quadmap/benchmark/BenchmarkResults.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/maps/MapEdits.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/obs/BoxObjects.h"
#include "quadmap/odometry/GraphOdometry.h"
#include "quadmap/review/KeyframeContent.h"
#include "quadmap/review/ReportPage.h"

using namespace quadmap;

namespace
{
std::string archiveBytes(const CQuadricObjectMap& map)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  return std::string(
      static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
}

CQuadricObjectMap mapOf(const std::string& archive)
{
  mrpt::io::CMemoryStream stream(archive.data(), archive.size());
  auto from = mrpt::serialization::archiveFrom(stream);
  CQuadricObjectMap map;
  from >> map;
  return map;
}

/** Two pieces of furniture, seen while walking around them. */
CQuadricObjectMap filledMap()
{
  const std::vector<quadmap::testing::TrueObject> world = {
      quadmap::testing::cuboid("suitcase", {0, 0, 0.3}, {0.8, 0.45, 0.6}, 0.3),
      quadmap::testing::cuboid("chair", {0.3, 1.4, 0.45}, {0.5, 0.5, 0.9}, -0.2)};
  quadmap::testing::SyntheticCamera camera(1);
  CQuadricObjectMap map;
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 0.4 * i;
    const auto pose = quadmap::testing::SyntheticCamera::lookAt(
        {3 * std::cos(angle), 0.7 + 3 * std::sin(angle), 1.3}, {0.1, 0.7, 0.4});
    map.insertObservation(camera.observe(pose, world), pose);
  }
  map.consolidate();
  return map;
}

/** Everything one does with a freshly read map must work, too. */
void use(CQuadricObjectMap& map)
{
  map.asString();
  map.toRecords();
  for (const auto* object : map.confirmedObjects()) map.footprint(object->id);
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  quadmap::testing::SyntheticCamera camera(2);
  const auto pose = quadmap::testing::SyntheticCamera::lookAt({3, 0, 1.3}, {0, 0, 0.4});
  const auto seen = camera.observe(
      pose, {quadmap::testing::cuboid("suitcase", {0, 0, 0.3}, {0.8, 0.45, 0.6}, 0.3)});
  map.computeObservationLikelihood(seen, pose);
  map.insertObservation(seen, pose);
  map.consolidate();
  CQuadricObjectMap again;
  EXPECT_NO_THROW(again = mapOf(archiveBytes(map))) << "what was read, used and written";
}
}  // namespace

TEST(Fuzz, MapArchive)
{
  const auto map = filledMap();
  ASSERT_FALSE(map.objects().empty());
  FuzzRun run;
  run.words = {"minViews", "\n[x]\n"};
  fuzz(
      archiveBytes(map), run,
      [](const std::string& bytes)
      {
        CQuadricObjectMap copy = mapOf(bytes);
        use(copy);
      });
}

TEST(Fuzz, CompressedMap)
{
  const TemporaryFolder folder;
  filledMap().saveToFile(folder.path("x.quadmap"));
  fuzz(
      readFile(folder.path("x.quadmap")), FuzzRun(),
      [&](const std::string& bytes)
      {
        CQuadricObjectMap copy;
        copy.loadFromFile(folder.write("x.quadmap", bytes));
        use(copy);
      });
}

namespace
{
/** Damages the keyframes of a simple map, but not its head: MRPT reads the head of a second simple
 * map, copied into the first one, within limits of memory which sanitizers do not survive. */
void fuzzKeyframes(
    const mrpt::maps::CSimpleMap& map,
    FuzzRun run,
    const std::function<void(const std::string& path)>& read)
{
  const TemporaryFolder folder;
  const auto path = writeObjects(
      folder.path("x.simplemap"), {std::make_shared<mrpt::maps::CSimpleMap>(map)}, false);
  const std::string valid = readFile(path);
  const std::size_t keyframes = valid.find("mrpt::poses::CPose3DPDFGaussian");
  ASSERT_NE(keyframes, std::string::npos);
  run.place = path;
  fuzz(
      valid.substr(keyframes), run,
      [&](const std::string& bytes)
      { read(folder.write("x.simplemap", valid.substr(0, keyframes) + bytes)); });
}

void addKeyframe(
    mrpt::maps::CSimpleMap& map, const std::vector<mrpt::obs::CObservation::Ptr>& observations)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  for (const auto& observation : observations) frame->insert(observation);
  map.insert(std::make_shared<mrpt::poses::CPose3DPDFGaussian>(), frame);
}
}  // namespace

TEST(Fuzz, SimpleMap)
{
  mrpt::maps::CSimpleMap map;
  addKeyframe(map, {samplePose(1000, {}), sampleScan(1000)});
  FuzzRun run;
  run.mostlyHarmless = true;  // most bytes are pixels
  fuzzKeyframes(
      map, run,
      [](const std::string& path)
      {
        SceneContent content;
        addKeyframes(path, {}, content);
      });
}

TEST(Fuzz, MapOfBoxes)
{
  mrpt::maps::CSimpleMap map;
  for (const double time : {1000.0, 1001.0}) addKeyframe(map, {sampleBoxes(time)});
  fuzzKeyframes(
      map, FuzzRun(),
      [](const std::string& path)
      {
        auto made = readMap(path);
        use(made);
      });
}

TEST(Fuzz, PoseGraph)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.words = {"VERTEX3", "EDGE3", "# TIME 1", "VERTEX2 1 2 3 4", "EQUIV 1 0", "-1", "\n\n"};
  fuzz(
      "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 0 0 0 0 0.1\n"
      "EDGE3 0 1 1 0 0 0 0 0.1 9 0 0 0 0 0 9 0 0 0 0 9 0 0 0 9 0 0 9 0 9\n"
      "# TIME 0 1000.25\n# TIME 1 1001.25\n",
      run,
      [&](const std::string& text)
      {
        GraphOdometry graph(folder.write("x.graph", text));
        graph.poseAt(1000.25);
      });
}

TEST(Fuzz, BenchmarkResults)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("runs/a"));
  folder.write("runs/a/job.txt", "simulated home 1 rgbd rawlog\n");
  folder.write("runs/a/machine.json", "{\"processor\": \"abacus\", \"commit\": \"1234567\"}\n");
  folder.write("runs/a/report.json", "{\"objects\": 0}\n");
  FuzzRun run;
  run.words = {"null", "[]", "{}", "\"label\":", "1e999", ","};
  fuzz(
      "{\"trajectory\": {\"ate_rmse_m\": 0.125}, \"objects\": {\"f1\": 1},\n"
      " \"matches\": [{\"id\": \"1\", \"label\": \"chair\", \"trans_m\": 0.1}]}\n",
      run,
      [&](const std::string& text)
      {
        folder.write("runs/a/evaluation.json", text);
        readBenchmarkResults(folder.folder().string());
      });
}

TEST(Fuzz, EditList)
{
  const CQuadricObjectMap map = filledMap();
  ASSERT_GE(map.objects().size(), 2u);
  const auto first = map.objects().begin()->first, last = map.objects().rbegin()->first;
  const TemporaryFolder folder;
  FuzzRun run;
  run.place = "edits.json";
  run.words = {
      "\"op\": \"remove\"",
      ", \"id\": 1e300",
      ", \"keep\": 1.5",
      "null",
      "true",
      "1e300",
      "-1.5",
      ",",
      "[0,0,0]"};
  fuzz(
      mrpt::format(
          R"({"format": "quadmap-edits", "version": 1, "map_sha256": "", "edits": [
 {"op": "place", "id": %u, "center": [1, 2, 0.5], "size": [0.5, 0.6, 1], "yaw": 0.3},
 {"op": "relabel", "id": %u, "label": "cup"},
 {"op": "merge", "keep": %u, "absorb": %u}, {"op": "remove", "id": %u}]})",
          first, first, first, last, first),
      run,
      [&](const std::string& text)
      {
        const auto path = folder.write("edits.json", text);
        const auto list = readMapEdits(path);
        CQuadricObjectMap edited = map;
        try
        {
          applyEdits(list.edits, edited);
        }
        catch (const std::exception& e)  // as quadmap-map says it
        {
          throw std::runtime_error(path + ": " + e.what());
        }
        edited.saveToFile(folder.path("edited.quadmap"));
        EXPECT_NO_THROW(edited.loadFromFile(folder.path("edited.quadmap"))) << text;
      });
}

TEST(Fuzz, RunReport)
{
  const TemporaryFolder folder;
  for (const char* name : {"trajectory.tum", "trajectory_odometry.tum"})
    folder.write(name, "1000.25 0 0 0 0 0 0 1\n1001.25 1 0 0 0 0 0 1\n");
  writeObjectsJson(folder.path("objects.json"), {});
  FuzzRun run;
  run.place = folder.folder().string();
  run.words = {"null", "[]", "{}", ", \"object\": 1e300", "1e300", "-1.5", "true", ","};
  fuzz(
      R"({"program": "quadmap-slam", "program_version": "1", "input": {"file": "a.rawlog"},
 "warnings": ["a warning"], "map_changes": {"new": 1}, "objects": 1,
 "dropped": [{"file": "a/b.rawlog", "record": 7, "sensor": "camera", "what": "is damaged"}],
 "boxes": {"total": 2, "by_label": {"chair": {"complete": 1, "reasons": {"too far": 2}}}},
 "timing": {"modules": {"perception": {"calls": 2, "cpu_total_s": 1.5}}, "threads": 2},
 "associations": [{"time": 1000.25, "sensor": "camera", "keyframe": 0, "boxes": [
  {"label": "chair", "box": [1, 2, 30, 40], "score": 0.9, "object": 1, "measurement": "complete"},
  {"label": "cup", "object": null, "reason": "too small"}]}]})",
      run,
      [&](const std::string& text)
      {
        BoxObjects(folder.write("report.json", text)).of("camera", 1000.25);
        reportPage(folder.folder().string());
      });
}
