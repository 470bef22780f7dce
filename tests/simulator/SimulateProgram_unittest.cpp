#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "SceneFixture.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap::simulator
{
namespace
{
struct ProgramResult
{
  int status = 0;
  std::string error;
};

/** Runs the program in `folder`. */
ProgramResult runProgram(const TemporaryFolder& folder, const std::string& arguments)
{
  const std::string command = "cd '" + folder.folder().string() +
                              "' && '" QUADMAP_BIN_DIR "/quadmap-simulate' " + arguments +
                              " > out.txt 2> err.txt";
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), readFile(folder.path("err.txt"))};
}

TEST(SimulateProgram, MakesARawlogFromASceneOfTheUser)
{
  const TemporaryFolder folder;
  folder.write(
      "mine.ini", kRoomText +
                      "[object x]\nlabel = cup\nposition = 1.5 0 1\n"
                      "part1 = cylinder 0 0 0.1 0.2 0.2 0.2 grey\n");
  const auto result = runProgram(
      folder, "mine.ini -o b.rawlog --seed 9 --frames 4 --resolution 160x120 --noise 0.5");
  EXPECT_EQ(0, result.status) << result.error;
  EXPECT_EQ("", result.error) << "no progress bar when redirected";
  EXPECT_NE(std::string::npos, readFile(folder.path("out.txt")).find("4 frames"));
  EXPECT_EQ(4U, readTumTrajectory(folder.path("b.groundtruth.tum")).size());
  const auto truth = readObjectsJson(folder.path("b.objects.gt.json"));
  ASSERT_EQ(1U, truth.size());
  EXPECT_EQ(4U, truth[0].framesVisible.value_or(0));
}

TEST(SimulateProgram, TakesImagesAtARate)
{
  const TemporaryFolder folder;
  folder.write("mine.ini", kRoomText + "duration = 4\n");
  const auto result = runProgram(folder, "mine.ini -o b.rawlog --rate 2.5 --resolution 64x64");
  EXPECT_EQ(0, result.status) << result.error;
  const Trajectory truth = readTumTrajectory(folder.path("b.groundtruth.tum"));
  ASSERT_EQ(10U, truth.size()) << "frames = rate * duration, not the scene's 5";
  for (std::size_t i = 1; i < truth.size(); ++i)
    EXPECT_NEAR(0.4, truth[i].time - truth[i - 1].time, 1e-5);
}

using Errs = std::array<bool, 3>;  // whether depth, odometry and boxes have errors

/** How a recording differs from that of perfect sensors. */
Errs errorsOf(const std::string& rawlog, const std::string& perfectRawlog)
{
  RawlogSource source(rawlog, RawlogSourceOptions()), perfect(perfectRawlog, RawlogSourceOptions());
  Errs errs{};
  while (const auto frame = source.next())
  {
    const auto truth = perfect.next();
    errs[0] |= frame->scan->rangeImage != truth->scan->rangeImage;
    errs[1] |= (*frame->T_odom_robot - *frame->T_world_robot).norm() > 1e-5;
    const auto &boxes = frame->objects->objects, &trueBoxes = truth->objects->objects;
    errs[2] |= boxes.size() != trueBoxes.size() || boxes.at(0).box.x1 != trueBoxes.at(0).box.x1;
  }
  return errs;
}

TEST(SimulateProgram, ScalesTheNoiseOfEachPart)
{
  const TemporaryFolder folder;
  folder.write(
      "mine.ini", kRoomText +
                      "[detector]\nmissRate = 0\n[object x]\nlabel = cup\nposition = 1.5 0 1\n"
                      "part1 = cylinder 0 0 0.1 0.2 0.2 0.2 grey\n");
  ASSERT_EQ(
      0, runProgram(folder, "mine.ini -o perfect.rawlog --resolution 64x64 --noise 0").status);
  for (const auto& [arguments, errs] : {
           std::pair{                            "",   Errs{true, true, true}},
           {   "--noise 0 --depth-noise 1", Errs{true, false, false}},
           {"--noise 0 --odometry-noise 1", Errs{false, true, false}},
           {"--noise 0 --detector-noise 1", Errs{false, false, true}},
           {             "--depth-noise 0",  Errs{false, true, true}},
           {          "--odometry-noise 0",  Errs{true, false, true}},
           {          "--detector-noise 0",  Errs{true, true, false}}
  })
  {
    const auto result =
        runProgram(folder, std::string("mine.ini -o noisy.rawlog --resolution 64x64 ") + arguments);
    EXPECT_EQ(0, result.status) << result.error;
    EXPECT_EQ(errs, errorsOf(folder.path("noisy.rawlog"), folder.path("perfect.rawlog")))
        << arguments;
  }
}

TEST(SimulateProgram, RejectsWrongCallsWithStatusTwo)
{
  const TemporaryFolder folder;
  for (const auto* arguments :
       {"",
        "home",
        "-o x.rawlog",
        "home -o",
        "home -o x.rawlog --seed -1",
        "home extra -o x.rawlog",
        "home -o x.rawlog --seed 1.5",
        "home -o x.rawlog --seed",
        "home -o x.rawlog --noise loud",
        "home -o x.rawlog --noise -1",
        "home -o x.rawlog --noise 11",
        "home -o x.rawlog --depth-noise 11",
        "home -o x.rawlog --odometry-noise much",
        "home -o x.rawlog --detector-noise -1",
        "home -o x.rawlog --rate 0",
        "home -o x.rawlog --rate 1e9",
        "home -o x.rawlog --rate fast",
        "home -o x.rawlog --rate 4 --frames 90",
        "home -o x.rawlog --noise nan",
        "home -o x.rawlog --frames 1",
        "home -o x.rawlog --frames many",
        "home -o x.rawlog --resolution 320",
        "home -o x.rawlog --resolution 10x10",
        "home -o x.rawlog --resolution 320x",
        "home -o x.rawlog --detections faces",
        "home -o x.rawlog --unknown"})
  {
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(2, result.status) << arguments;
    EXPECT_EQ(0U, result.error.find("quadmap-simulate: ")) << result.error;
    EXPECT_EQ(result.error.size() - 1, result.error.find('\n')) << "one line: " << result.error;
  }
  EXPECT_EQ(2U, folder.fileCount()) << "only what the shell wrote";
}

TEST(SimulateProgram, WritesTheRandomRoomWithTheRecordingOrNotAtAll)
{
  const TemporaryFolder folder;
  const std::string room = "random --frames 2 --resolution 64x64 --write-scene room.ini -o ";
  EXPECT_EQ(1, runProgram(folder, room + "missing/a.rawlog").status);
  EXPECT_EQ(2, runProgram(folder, room + "a.rawlog --resolution 1x1").status);
  EXPECT_EQ(1, runProgram(folder, room + "room.ini/a.rawlog").status);
  EXPECT_EQ(2U, folder.fileCount()) << "only what the shell wrote";
  const auto result = runProgram(folder, room + "a.rawlog");
  EXPECT_EQ(0, result.status) << result.error;
  EXPECT_EQ(0, runProgram(folder, "room.ini --frames 2 --resolution 64x64 -o b.rawlog").status);
  EXPECT_EQ(readFile(folder.path("a.objects.gt.json")), readFile(folder.path("b.objects.gt.json")));
}

TEST(SimulateProgram, KeepsTheSceneThatItReads)
{
  const TemporaryFolder folder;
  for (const auto& [scene, output] :
       {std::pair("./mine.ini", "mine.ini"), std::pair("./a.objects.gt.json", "a.rawlog")})
  {
    folder.write(scene, kRoomText);
    const auto result = runProgram(
        folder, std::string(scene) + " -o " + std::string(output) + " --resolution 64x64");
    EXPECT_EQ(2, result.status) << scene;
    EXPECT_NE(std::string::npos, result.error.find("which is read and stays")) << result.error;
    EXPECT_EQ(kRoomText, readFile(folder.path(scene)));
    std::filesystem::remove(folder.path(scene));
  }
}

TEST(SimulateProgram, RefusesASceneFileThatIsOneOfTheRecording)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("sub"));
  for (const auto* name :
       {"a.rawlog", "a.objects.rawlog", "./a.objects.gt.json", "sub/../a.groundtruth.tum"})
  {
    const auto result =
        runProgram(folder, std::string("random --frames 2 -o a.rawlog --write-scene ") + name);
    EXPECT_EQ(2, result.status) << name;
    EXPECT_EQ(
        "quadmap-simulate: --write-scene: " + std::string(name) +
            " is the file of -o as well; give each its own (see quadmap-simulate --help)\n",
        result.error);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.rawlog")));
}

TEST(SimulateProgram, NamesTheBadFileWithStatusOne)
{
  const TemporaryFolder folder;
  folder.write("bad.ini", kRoomText + "[object x]\nlabel = cup\nposition = 1 0\n");
  for (const auto& [arguments, part] : {
           std::pair{            "bad.ini -o x.rawlog", "bad.ini: [object x] position"},
           {            "nowhere -o x.rawlog",           "scenes/nowhere.ini"},
           {         "./none.ini -o x.rawlog",                   "./none.ini"},
           {"home -o no/such/folder/x.rawlog",      "no/such/folder/x.rawlog"}
  })
  {
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(1, result.status) << arguments;
    EXPECT_NE(std::string::npos, result.error.find(part)) << result.error;
    EXPECT_EQ(result.error.size() - 1, result.error.find('\n')) << "one line";
  }
}

}  // namespace
}  // namespace quadmap::simulator
