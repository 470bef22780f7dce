#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
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
#include "quadmap/odometry/GraphOdometry.h"
#include "quadmap/review/KeyframeContent.h"
#include "quadmap/slam/SlamConfiguration.h"

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
  archiveBytes(map);
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
        mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
        auto archive = mrpt::serialization::archiveFrom(stream);
        CQuadricObjectMap copy;
        archive >> copy;
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

TEST(Fuzz, SimpleMap)
{
  mrpt::maps::CSimpleMap map;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(samplePose(1000, {}));
  frame->insert(sampleScan(1000));
  map.insert(std::make_shared<mrpt::poses::CPose3DPDFGaussian>(), frame);
  const TemporaryFolder folder;
  const auto path = writeObjects(
      folder.path("x.simplemap"), {std::make_shared<mrpt::maps::CSimpleMap>(map)}, false);
  FuzzRun run;
  run.mostlyHarmless = true;  // most bytes are pixels
  fuzz(
      readFile(path), run,
      [&](const std::string& bytes)
      {
        SceneContent content;
        addKeyframes(folder.write("x.simplemap", bytes), {}, content);
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
  folder.write("runs/a/machine.json", "{\"commit\": \"1234567\"}\n");
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

TEST(Fuzz, SlamConfiguration)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.words = {"[slam]", "[input]", "[]", "= yes", "${", "@define"};
  fuzz(
      SlamConfiguration().toConfig().getContent(), run,
      [&](const std::string& text)
      { SlamConfiguration::fromFile(folder.write("quadmap.ini", text)).toConfig(); });
}
