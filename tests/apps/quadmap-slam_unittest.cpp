#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "../../apps/common/ResultFiles.h"
#include "../slam/SyntheticRoom.h"
#include "RunProgram.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
/** A good recording to spoil, and a folder for what is written. */
class QuadmapSlam : public ::testing::Test
{
 protected:
  using Records = std::vector<mrpt::serialization::CSerializable::Ptr>;

  /** Arguments with IN for the rawlog and DIR for the folder. */
  ProgramResult run(const std::string& arguments) const
  {
    return runProgram(
        "quadmap-slam",
        replaced(replaced(arguments, "IN", "DIR/x.rawlog"), "DIR", folder_.folder().string()));
  }

  Records records() const { return recordsOf({}, {}); }
  void write(const Records& r) const { writeObjects(folder_.path("x.rawlog"), r); }
  mrpt::obs::CObservation3DRangeScan& scanOf(Records& r, std::size_t frame) const
  {
    return dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(*r.at(3 * frame + 1));
  }
  ImageBox& boxOf(Records& r, std::size_t frame) const
  {
    return dynamic_cast<CObservationObjects&>(*r.at(3 * frame + 2)).objects.at(0).box;
  }

  /** Writes a recording of a robot that stands still for so many frames, 0.1 s apart. */
  void writeLong(int frames) const
  {
    const SyntheticRoom room;
    const auto pose = room.robotAt(0);
    const auto scan = room.scanFrom(pose, kStart);
    const auto boxes = room.boxesOf(*scan, pose);
    mrpt::io::CFileGZOutputStream stream(folder_.path("x.rawlog"));
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (int i = 0; i < frames; ++i)
    {
      scan->timestamp = boxes->timestamp = stamp(kStart + 0.1 * i);
      archive << *samplePose(kStart + 0.1 * i, pose) << *scan << *boxes;
    }
  }

  /** Expects that the program fails with one line that has all of `parts`, and writes nothing. With
   * --keep-going it must succeed, say what it left out, and have that many keyframes. */
  void expectProblem(const std::vector<std::string>& parts, std::size_t keyframesLeft) const
  {
    const auto strict = run("IN -o DIR/out --every 1");
    EXPECT_EQ(strict.status, 1);
    EXPECT_TRUE(isOneLine(strict.err)) << strict.err;
    EXPECT_TRUE(strict.out.empty()) << strict.out;
    for (const auto& part : parts) EXPECT_NE(strict.err.find(part), kNotFound) << strict.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));

    const auto tolerant = run("IN -o DIR/tolerant --every 1 --keep-going");
    EXPECT_EQ(tolerant.status, 0) << tolerant.err;
    EXPECT_NE(tolerant.err.find("quadmap-slam: left out: "), kNotFound) << tolerant.err;
    for (const auto& part : parts) EXPECT_NE(tolerant.err.find(part), kNotFound) << tolerant.err;
    EXPECT_EQ(readTumTrajectory(folder_.path("tolerant/trajectory.tum")).size(), keyframesLeft);
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapSlam, MapsTheRoomAndNamesItsFiles)
{
  write(records());
  const auto result = run("IN -o DIR/out --every 1");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.err.empty()) << "no progress bar when redirected: " << result.err;
  EXPECT_NE(result.out.find("suitcase"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("6 frames, 6 keyframes, 6 boxes, 1 objects"), kNotFound) << result.out;
  std::set<std::string> written;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("out")))
    written.insert(entry.path().filename().string());
  EXPECT_EQ(written, cli::resultFiles()) << "which other programs do not write over";
  for (const auto& name : cli::resultFiles())
  {
    EXPECT_NE(result.out.find("wrote " + folder_.path("out/") + name), kNotFound) << name;
    EXPECT_GT(std::filesystem::file_size(folder_.path("out/") + name), 0u) << name;
  }
}

TEST_F(QuadmapSlam, ConfigurationFileAndOptionsAreUsed)
{
  write(records());
  const auto ini = folder_.write("x.ini", "[keyframes]\nevery=3\n[slam]\nmethod=odometry\n");
  ASSERT_EQ(run("IN -o DIR/a -c " + ini).status, 0);
  EXPECT_EQ(readTumTrajectory(folder_.path("a/trajectory.tum")).size(), 2u);
  EXPECT_TRUE(readObjectsJson(folder_.path("a/objects.json")).empty());
  ASSERT_EQ(run("IN -o DIR/b --every 1 --method rgbd -c " + ini).status, 0);
  EXPECT_EQ(readTumTrajectory(folder_.path("b/trajectory.tum")).size(), 6u);
  EXPECT_EQ(readObjectsJson(folder_.path("b/objects.json")).size(), 1u);
  const auto bad = run("IN -o DIR/c -c " + folder_.write("bad.ini", "[slam]\nmetod=rgbd\n"));
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.err.find("bad.ini: [slam] unknown key \"metod\""), kNotFound) << bad.err;
}

TEST_F(QuadmapSlam, BoxesOfASidecarAndOfANamedFile)
{
  Records stock, boxes;
  for (const auto& r : records())
    (std::dynamic_pointer_cast<CObservationObjects>(r) ? boxes : stock).push_back(r);
  write(stock);
  const auto none = run("IN -o DIR/out");
  EXPECT_EQ(none.status, 1);
  EXPECT_TRUE(isOneLine(none.err)) << none.err;
  EXPECT_NE(none.err.find("x.rawlog: no object boxes"), kNotFound) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));

  writeObjects(folder_.path("boxes.rawlog"), boxes);
  EXPECT_EQ(run("IN -o DIR/a --objects DIR/boxes.rawlog").status, 0);
  std::filesystem::rename(folder_.path("boxes.rawlog"), folder_.path("x.objects.rawlog"));
  EXPECT_EQ(run("IN -o DIR/b").status, 0);
  for (const auto* out : {"a", "b"})
    EXPECT_EQ(readObjectsJson(folder_.path(out) + "/objects.json").size(), 1u);
  const auto missing = run("IN -o DIR/c --objects DIR/none.rawlog");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("none.rawlog"), kNotFound) << missing.err;
}

TEST_F(QuadmapSlam, TellsAsMuchAsAsked)
{
  SyntheticRoom room;
  room.label = "strange thing";
  write(recordsOf(room, {}));
  const auto debug = run("IN -o DIR/out -v debug"), info = run("IN -o DIR/out");
  const auto warn = run("IN -o DIR/out -v warn"), error = run("IN -o DIR/out -v error");
  EXPECT_NE(debug.err.find("keyframe 5: record 16 (camera), 1 boxes"), kNotFound) << debug.err;
  EXPECT_NE(debug.err.find("label             boxes   complete"), kNotFound) << debug.err;
  EXPECT_NE(debug.err.find("all                   6"), kNotFound) << debug.err;
  EXPECT_NE(debug.err.find("no known label: strange thing"), kNotFound) << debug.err;
  EXPECT_FALSE(info.out.empty());
  for (const auto* r : {&info, &warn})
  {
    EXPECT_TRUE(isOneLine(r->err)) << r->err;
    const std::string begin =
        "quadmap-slam: warning: " + folder_.path("x.rawlog") + ": labels that";
    EXPECT_EQ(r->err.find(begin + " are not in the label table: strange thing; "), 0u) << r->err;
  }
  EXPECT_TRUE(warn.out.empty()) << warn.out;
  EXPECT_TRUE(error.out.empty() && error.err.empty()) << error.out << error.err;
}

TEST_F(QuadmapSlam, WrongUsage)
{
  for (const auto* arguments :
       {"", "IN", "-o DIR/out", "IN -o DIR/out --method magic", "IN -o DIR/out --odometry dead",
        "IN -o DIR/out --every 0", "IN -o DIR/out --every two", "IN -o DIR/out --evry 2",
        "IN -o DIR/out --threads -1", "IN -o DIR/out --threads 65"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments << ": " << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
  }
  EXPECT_EQ(run("--help").status, 0);
  EXPECT_EQ(run("--version").out.find("quadmap-slam "), 0u);
}

TEST_F(QuadmapSlam, PrintsTheOptionsItTakes)
{
  const auto result = run("--defaults");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, readFile(QUADMAP_SOURCE_DIR "/share/quadmap/quadmap.ini"));
}

TEST_F(QuadmapSlam, SaysWhyItCannotStartInAMap)
{
  write(records());
  ASSERT_EQ(run("IN -o DIR/first --every 1").status, 0);
  const std::string map = folder_.path("first/objects.quadmap");
  const std::pair<std::string, std::string> cases[] = {
      {                    "--map DIR/first/objects.quadmap",                                      map},
      {                                   "--map DIR/no.map", folder_.path("no.map: there is no such")},
      {                        "--map DIR/first/report.json",                       "is no object map"},
      {     "--map DIR/first/objects.quadmap --method point",                      "--map: for method"},
      {"--map DIR/first/objects.quadmap --association given",      "--map: not with association given"}
  };
  for (const auto& [arguments, part] : cases)
  {
    const auto result = run("IN -o DIR/out --every 1 " + arguments);
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out"))) << arguments;
  }
}

TEST_F(QuadmapSlam, TruncatedFile)
{
  write(records());
  const auto file = folder_.path("x.rawlog");
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 300);
  expectProblem({"x.rawlog: record 16", "truncated"}, 5);
}

TEST_F(QuadmapSlam, UnknownClass)
{
  write(records());
  std::string bytes = readFile(writeObjects(folder_.path("plain.rawlog"), records(), false));
  const std::string name = "mrpt::obs::CObservationRobotPose";
  auto at = kNotFound;
  for (int i = 0; i < 3; ++i) at = bytes.find(name, at + 1);
  bytes.replace(at, name.size(), "mrpt::obs::CObservationRobotNose");
  folder_.write("x.rawlog", bytes);
  expectProblem({"x.rawlog: record 6", "CObservationRobotNose"}, 6);  // the frames behind it stay
}

TEST_F(QuadmapSlam, MissingExternalImage)
{
  auto r = records();
  scanOf(r, 2).intensityImage.setExternalStorage("gone.jpg");
  write(r);
  expectProblem({"x.rawlog: record 7 (camera): ", "gone.jpg"}, 5);
}

TEST_F(QuadmapSlam, MissingCalibration)
{
  auto r = records();
  scanOf(r, 1).cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  write(r);
  expectProblem({"x.rawlog: record 4 (camera): "}, 5);
}

TEST_F(QuadmapSlam, UnusableBoxes)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ImageBox bad[] = {
      {nan,  10,  40,  50},
      { 40,  40,  40,  80},
      { 90,  90,  40,  50},
      {-90, -90, -40, -50}
  };
  for (const auto& box : bad)
  {
    auto r = records();
    boxOf(r, 3) = box;
    write(r);
    expectProblem({"x.rawlog: record 11 (camera): ", "suitcase"}, 6);
  }
}

TEST_F(QuadmapSlam, NoDepthInAnyImage)
{
  auto r = records();
  for (std::size_t i = 0; i < 6; ++i) scanOf(r, i).rangeImage.fill(0);
  write(r);
  const auto result = run("IN -o DIR/out --every 1");
  EXPECT_EQ(result.status, 0) << "boxes alone can make a map: " << result.err;
  const auto report = json::parse(readFile(folder_.path("out/report.json")));
  EXPECT_EQ(report["input"]["keyframes_without_depth"], 6);
  EXPECT_NE(report["warnings"].dump().find("no valid depth"), kNotFound) << report["warnings"];
  EXPECT_EQ(report["boxes"]["by_label"]["suitcase"]["complete"], 0);
  EXPECT_EQ(report["boxes"]["by_label"]["suitcase"]["shares"]["complete"], 0.0);
  EXPECT_EQ(report["boxes"]["by_label"]["suitcase"]["shares"]["partial"], 1.0);
}

TEST_F(QuadmapSlam, NegativeFyMapsTheSameBox)
{
  SyntheticRoom room;
  write(recordsOf(room, {}));
  ASSERT_EQ(run("IN -o DIR/up --every 1").status, 0);
  room.camera.fy = -room.camera.fy;  // ICL-NUIM: the rows run the other way
  write(recordsOf(room, {}));
  ASSERT_EQ(run("IN -o DIR/down --every 1").status, 0);
  const auto up = readObjectsJson(folder_.path("up/objects.json"));
  const auto down = readObjectsJson(folder_.path("down/objects.json"));
  ASSERT_EQ(up.size(), 1u);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_LT((up[0].object.center() - down[0].object.center()).norm(), 0.01) << "[m], pixel grid";
}

TEST_F(QuadmapSlam, NoImages)
{
  write({samplePose(kStart, {}), samplePose(kStart + 1, {})});
  const auto result = run("IN -o DIR/out");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("it has 2 CObservationRobotPose"), kNotFound) << result.err;
}

TEST_F(QuadmapSlam, FilesThatCannotBeReadOrWritten)
{
  const auto missing = run("DIR/no.rawlog -o DIR/out");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("no.rawlog: "), kNotFound) << missing.err;
  write(records());
  const auto file = run("IN -o DIR/x.rawlog");
  EXPECT_EQ(file.status, 1);
  EXPECT_TRUE(isOneLine(file.err)) << file.err;
  const auto proc = run("IN -o /proc/out");
  EXPECT_EQ(proc.status, 1);
  EXPECT_NE(proc.err.find("/proc/out: cannot be made"), kNotFound) << proc.err;
}

TEST_F(QuadmapSlam, FullDisk)
{
  write(records());
  const FileSizeLimit limit(20000);  // the program inherits it
  const auto result = run("IN -o DIR/out");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("cannot be written"), kNotFound) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
}

TEST_F(QuadmapSlam, FullDiskLeavesNoTruncatedScene)
{
  write(records());
  ASSERT_EQ(run("IN -o DIR/whole --every 1").status, 0);
  const auto size = std::filesystem::file_size(folder_.path("whole/scene.3Dscene"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("whole")))
    ASSERT_LE(entry.file_size(), size) << entry.path() << ": the scene is to be the largest";
  const FileSizeLimit limit(size - 1);  // the very last byte fails
  const auto result = run("IN -o DIR/out --every 1");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("scene.3Dscene: cannot be written: "), kNotFound) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/scene.3Dscene")));
}

TEST_F(QuadmapSlam, MemoryDoesNotGrowWithTheRecording)
{
  const auto peak_mb = [&](int frames) -> double
  {
    writeLong(frames);
    EXPECT_EQ(run("IN -o DIR/out --every 1").status, 0);
    return json::parse(readFile(folder_.path("out/report.json")))["timing"]["peak_memory_mb"];
  };
  const double ofShort = peak_mb(50);  // more than the frames that wait for poses
  // The images of the 200 further frames have 77 MB, compressed 5 MB
  EXPECT_LT(peak_mb(250), ofShort + 4.0);
}

class QuadmapSlamStopped :
    public QuadmapSlam,
    public ::testing::WithParamInterface<std::pair<int, int>>
{
};
INSTANTIATE_TEST_SUITE_P(
    Signals,
    QuadmapSlamStopped,
    ::testing::Values(std::pair(SIGINT, 130), std::pair(SIGTERM, 143)));

TEST_P(QuadmapSlamStopped, LeavesValidFilesOfWhatWasDone)
{
  constexpr int kFrames = 300;  // some seconds of work
  writeLong(kFrames);
  const std::string program = std::string(QUADMAP_BIN_DIR) + "/quadmap-slam";
  const std::string in = folder_.path("x.rawlog"), out = folder_.path("out");
  std::vector<const char*> arguments{program.c_str(), in.c_str(), "-o",   out.c_str(),
                                     "--every",       "1",        nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, descriptor, "/dev/null", O_WRONLY, 0);
  pid_t pid = 0;
  ASSERT_EQ(
      posix_spawn(
          &pid, program.c_str(), &quiet, nullptr, const_cast<char**>(arguments.data()), environ),
      0);
  posix_spawn_file_actions_destroy(&quiet);
  const auto spoolHasData = [&]  // the file has no name, but the program has it open
  {
    std::error_code ignored;
    const std::string open = "/proc/" + std::to_string(pid) + "/fd";
    for (const auto& entry : std::filesystem::directory_iterator(open, ignored))
      if (std::filesystem::read_symlink(entry, ignored).string().find(out + "/.keyframes") == 0)
        return std::filesystem::file_size(entry, ignored) > 0;
    return false;
  };
  for (int i = 0; i < 3000 && !spoolHasData(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(pid, GetParam().first);
  int status = 0;
  ASSERT_EQ(::waitpid(pid, &status, 0), pid);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), GetParam().second);
  const auto keyframes = readTumTrajectory(out + "/trajectory.tum").size();
  EXPECT_GE(keyframes, 1u);
  EXPECT_LT(keyframes, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(json::parse(readFile(out + "/report.json"))["input"]["interrupted"], true);
  EXPECT_TRUE(std::filesystem::exists(out + "/scene.3Dscene"));
}
