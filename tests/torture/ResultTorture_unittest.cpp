#include <gtest/gtest.h>

#include "../apps/SampleMap.h"
#include "../slam/SyntheticRoom.h"
#include "Damages.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/obs/ObjectList.h"

using namespace quadmap;
using namespace quadmap::torture;

namespace
{
/** The files of a run on a small room. */
class ResultTorture : public ::testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    made_ = new TemporaryFolder;
    SyntheticRoom room;
    room.camera = {65, 65, 39.5, 29.5, 80, 60};
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (int i = 0; i < 4; ++i)
    {
      const auto pose = room.robotAt(0.1 * i);
      const auto scan = room.scanFrom(pose, kStart + i);
      records.insert(
          records.end(), {samplePose(kStart + i, pose), scan, room.boxesOf(*scan, pose)});
    }
    writeObjects(made_->path("x.rawlog"), records);
    const std::string command = QUADMAP_BIN_DIR "/quadmap-slam " + made_->path("x.rawlog") +
                                " --every 1 -o " + made_->path("run") + " >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  static void TearDownTestSuite() { delete made_; }

  ResultTorture()
  {
    std::filesystem::copy(
        made_->folder(), folder_.folder(), std::filesystem::copy_options::recursive);
  }
  std::string resultFile(const std::string& name) const
  {
    return readFile(folder_.path("run/" + name));
  }

  static TemporaryFolder* made_;
  TemporaryFolder folder_;
};
TemporaryFolder* ResultTorture::made_ = nullptr;

/** What a compressed file of several members holds. */
std::string unpacked(const std::string& path)
{
  GzInput file(path);
  file.startRecord();
  std::string bytes;
  for (char c = 0; file.Read(&c, 1) == 1; file.startRecord()) bytes += c;
  return bytes;
}
}  // namespace

TEST_F(ResultTorture, ObjectMap)
{
  const TemporaryFolder folder;
  sampleMap().saveToFile(folder.path("whole.quadmap"));
  const auto packed = readFile(folder.path("whole.quadmap"));
  const auto whole = unpacked(folder.path("whole.quadmap"));
  const auto options = whole.find("[options]");
  const auto tables = whole.size() - 4000;
  Cases inside = flips(whole, 15);
  for (const auto& c : hugeNumbers(whole.substr(tables), 25))
    inside.push_back({c.name, whole.substr(0, tables) + c.bytes});
  for (const auto& c : hugeNumbers(whole.substr(options - 8, 4000), 10))
    inside.push_back(
        {c.name, whole.substr(0, options - 8) + c.bytes + whole.substr(options + 3992)});
  inside.push_back({"followed by 1 GB of nothing", whole + std::string(1u << 28, '\0'), true});
  Cases cases = flips(packed, 60) + cuts(packed, 10) + compressed(inside);
  for (auto& c : cases) c.mustFail = c.mustFail || c.name.rfind("cut", 0) == 0;
  judge(folder, {"quadmap-map info IN", "x.quadmap", ""}, cases);
}

TEST_F(ResultTorture, SimpleMap)
{
  const auto packed = resultFile("map.simplemap");
  const auto whole = unpacked(folder_.path("run/map.simplemap"));
  Cases inside = flips(whole, 8) + hugeNumbers(whole.substr(0, 1200), 30);
  for (std::size_t i = 8; i < inside.size(); ++i) inside[i].bytes += whole.substr(1200);
  const auto scan = whole.find("CObservation3DRangeScan\x0a");
  ASSERT_NE(scan, std::string::npos);
  for (const std::uint32_t number : {0xffffffffu, 0x10000u})
    inside.push_back(
        {"a depth image of " + std::to_string(number),
         with(
             whole, littleEndian(60) + littleEndian(80),
             littleEndian(number) + littleEndian(number)),
         true});
  judge(
      folder_, {"quadmap-export DIR/run --ply OUT", "run/map.simplemap", "map.simplemap"},
      flips(packed, 20) + cuts(packed, 8) + compressed(inside));
}

TEST_F(ResultTorture, PoseGraph)
{
  const auto whole = resultFile("pose-graph.graph");
  const Cases cases = cuts(whole, 8) + flips(whole, 10) + wrongWords(whole, 24);
  judge(
      folder_,
      {"quadmap-slam DIR/x.rawlog -o OUT --every 1 --odometry graph:DIR/x.graph", "x.graph", ""},
      cases);
}

TEST_F(ResultTorture, Trajectory)
{
  const auto whole = resultFile("trajectory.tum");
  Cases cases = cuts(whole, 8) + flips(whole, 12) + wrongWords(whole, 30);
  cases.push_back({"one line of 40 MB", std::string(40u << 20, '1'), true});
  std::string many;
  while (many.size() < (48u << 20)) many += "1 0 0 0 0 0 0 1\n";
  cases.push_back({"3 million poses", many, true});
  judge(folder_, {"quadmap-evaluate DIR/run --trajectory IN", "x.tum", ""}, cases);
}

TEST_F(ResultTorture, TrueObjects)
{
  const auto whole = objectsToJson(sampleMap().toRecords());
  Cases cases = cuts(whole, 8) + flips(whole, 20) + wrongWords(whole, 8);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {        "\"id\":",      "\"id\":[],\"x\":"},
           {     "\"size\":[",           "\"size\":[-"},
           {     "\"size\":[",      "\"size\":[1e308,"},
           {   "\"center\":[",     "\"center\":[null,"},
           {"\"rotation\":[[",     "\"rotation\":[[7,"},
           {   "\"objects\":", "\"objects\":{},\"x\":"},
           {   "\"label\":\"", "\"label\":{},\"x\":\""}
  })
    cases.push_back({to, with(whole, from, to), true});
  for (const char* opening : {"[", "{\"a\":", "{\"objects\":["})
  {
    std::string deep;
    while (deep.size() < (20u << 20)) deep += opening;
    cases.push_back({"nested", deep, true});
  }
  std::string zeros = "[0";
  while (zeros.size() < (40u << 20)) zeros += ",0";
  cases.push_back({"20 million numbers", zeros + "]", true});
  std::string things = "{\"format\":\"quadmap-objects\",\"version\":1,\"objects\":[{}";
  for (int i = 0; i < 500000; ++i) things += ",{}";
  cases.push_back({"half a million empty objects", things + "]}", true});
  std::vector<ObjectRecord> many(20000);
  for (std::size_t i = 0; i < many.size(); ++i)
  {
    many[i].id = std::to_string(i);
    many[i].label = "chair";
  }
  cases.push_back({"20,000 objects", objectsToJson(many), true});
  judge(folder_, {"quadmap-evaluate DIR/run --in-place --objects IN", "x.json", ""}, cases);
}

TEST_F(ResultTorture, BenchmarkResults)
{
  const std::string evaluation =
      "{\"trajectory\": {\"ate_rmse_m\": 0.125, \"keyframes\": 3}, \"objects\": {\"f1\": 1},\n"
      " \"matches\": [ {\"truth_id\": \"1\", \"id\": \"1\", \"label\": \"chair\", \"trans_m\": "
      "0.1} ]}\n";
  std::filesystem::create_directories(folder_.path("results/runs/a"));
  folder_.write("results/runs/a/job.txt", "simulated home 1 rgbd rawlog\n");
  folder_.write(
      "results/runs/a/machine.json", "{\"processor\": \"abacus\", \"commit\": \"1234567\"}\n");
  folder_.write("results/runs/a/report.json", "{\"objects\": 0}\n");
  const Cases cases = cuts(evaluation, 6) + flips(evaluation, 12) + wrongWords(evaluation, 8);
  judge(
      folder_,
      {"quadmap-benchmark merge DIR/results", "results/runs/a/evaluation.json", "results/runs/a"},
      cases);
}
