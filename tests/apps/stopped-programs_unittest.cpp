#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "../detection/TinyDetector.h"
#include "../folders/SampleRecording.h"
#include "../obs/FileSizeLimit.h"
#include "RunProgram.h"

extern char** environ;

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
/** A program that runs beside the test. */
class RunningProgram
{
 public:
  RunningProgram(const std::string& program, std::vector<std::string> arguments, std::string log)
  {
    arguments.insert(arguments.begin(), std::string(QUADMAP_BIN_DIR) + "/" + program);
    std::vector<char*> words;
    for (auto& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(
        &files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    EXPECT_EQ(posix_spawn(&pid_, words[0], &files, nullptr, words.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
  }

  void send(int signal) const { ::kill(pid_, signal); }
  pid_t pid() const { return pid_; }

  /** \return Its status as of a shell: 128 + the signal that ended it. */
  int wait() const
  {
    int status = 0;
    EXPECT_EQ(::waitpid(pid_, &status, 0), pid_);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = 0;
};

void waitUntil(const std::function<bool()>& holds)
{
  for (int i = 0; i < 6000 && !holds(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(holds());
}

/** Bytes of all files in a folder and those below. */
std::uintmax_t bytesIn(const fs::path& folder)
{
  std::uintmax_t bytes = 0;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) bytes += entry.file_size(ignored);
  return bytes;
}

class StoppedPrograms : public ::testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    recordings_ = new TemporaryFolder;
    for (const auto& [name, frames] : {std::pair("short", "12"), std::pair("long", "400")})
      ASSERT_EQ(
          runProgram(
              "quadmap-simulate", std::string("home --resolution 160x120 --frames ") + frames +
                                      " -o " + recordings_->path(name) + ".rawlog")
              .status,
          0);
  }
  static void TearDownTestSuite() { delete recordings_; }

  static std::string recording(const std::string& name)
  {
    return recordings_->path(name + ".rawlog");
  }
  std::string out() const { return folder_.path("out"); }
  std::string log() const { return readFile(recordings_->path("log")); }

  RunningProgram start(const std::string& program, const std::vector<std::string>& arguments) const
  {
    return {program, arguments, recordings_->path("log")};
  }

  /** quadmap-slam on the long recording, when it has its first keyframe. */
  RunningProgram startLongRun(const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> arguments{recording("long"), "-o", out(), "--every", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto program = start("quadmap-slam", arguments);
    const auto spoolHasData = [&]  // the file has no name, but the program has it open
    {
      std::error_code ignored;
      for (const auto& entry :
           fs::directory_iterator("/proc/" + std::to_string(program.pid()) + "/fd", ignored))
        if (fs::read_symlink(entry, ignored).string().find("/.keyframes") != std::string::npos)
          return fs::file_size(entry, ignored) > 0;
      return false;
    };
    waitUntil(spoolHasData);
    return program;
  }

  bool interrupted(const std::string& report) const
  {
    return nlohmann::json::parse(readFile(report))["input"]["interrupted"];
  }

  TemporaryFolder folder_;
  static TemporaryFolder* recordings_;
};
TemporaryFolder* StoppedPrograms::recordings_ = nullptr;
}  // namespace

TEST_F(StoppedPrograms, DetectLeavesTheBoxesThatThereWere)
{
  const TinyDetector tiny;
  const std::string boxes = folder_.write("boxes.rawlog", "as before");
  const std::string pictures = folder_.path("pictures");
  const auto program = start(
      "quadmap-detect",
      {recording("long"), "--model", tiny.model(), "-o", boxes, "--draw", pictures});
  waitUntil([&] { return bytesIn(pictures) > 0; });
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 128 + SIGINT) << log();
  EXPECT_EQ(readFile(boxes), "as before");
  EXPECT_EQ(folder_.fileCount(), 1u);
}

TEST_F(StoppedPrograms, ASimulationThatASignalEndsChangesNothing)
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
  {
    const auto program =
        start("quadmap-simulate", {"home", "--frames", "5000", "-o", folder_.path("x.rawlog")});
    waitUntil([&] { return bytesIn(folder_.folder()) > 0; });
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal);
    EXPECT_EQ(folder_.fileCount(), 0u) << signal;
  }
}

TEST_F(StoppedPrograms, AFileThatMayNotGrowIsLikeAFullDisk)
{
  const FileSizeLimit limit(20000);
  std::signal(SIGXFSZ, SIG_DFL);  // as programs find it, which ends them
  const auto program =
      start("quadmap-simulate", {"home", "--frames", "5", "-o", folder_.path("x.rawlog")});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(log().find(folder_.path("x.rawlog")), std::string::npos) << log();
  EXPECT_EQ(folder_.fileCount(), 0u);
}

TEST_F(StoppedPrograms, AnImportThatASignalEndsChangesNothing)
{
  const SampleRecording recording;
  constexpr int kFrames = 10000;
  std::string associations;
  for (int i = SampleRecording::kFrames; i < kFrames; ++i)
  {
    fs::create_symlink("f0.png", recording.files.path(mrpt::format("rgb/f%d.png", i)));
    fs::create_symlink("f0.png", recording.files.path(mrpt::format("depth/f%d.png", i)));
    associations +=
        SampleRecording::line(i, SampleRecording::kStart + SampleRecording::kInterval * i);
  }
  recording.files.write("associations.txt", associations);
  folder_.write("x.rawlog", "as before");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
  {
    const auto before = bytesIn(folder_.folder());
    const auto program =
        start("quadmap-import", {"tum", recording.folder(), "-o", folder_.path("x.rawlog")});
    waitUntil([&] { return bytesIn(folder_.folder()) > before; });
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal) << log();
    EXPECT_EQ(readFile(folder_.path("x.rawlog")), "as before");
    EXPECT_EQ(folder_.fileCount(), 1u) << signal;
  }
}

TEST_F(StoppedPrograms, ARunRefusesAFolderThatAnotherWritesAndTheOtherGoesOn)
{
  const auto first = startLongRun();
  const auto second = runProgram("quadmap-slam", recording("short") + " -o " + out());
  EXPECT_EQ(second.status, 1);
  EXPECT_NE(second.err.find("another program is writing"), std::string::npos) << second.err;
  first.send(SIGINT);
  EXPECT_EQ(first.wait(), 130);
  EXPECT_TRUE(fs::exists(out() + "/report.json"));
}

TEST_F(StoppedPrograms, AnInterruptedRunReplacesACompleteOneOnlyWhenToldTo)
{
  ASSERT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + out()).status, 0);
  const std::string report = out() + "/report.json", complete = readFile(report);
  const auto run = startLongRun();
  run.send(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_EQ(readFile(report), complete);
  EXPECT_TRUE(interrupted(out() + "/interrupted/report.json"));
  EXPECT_NE(log().find("--replace"), std::string::npos) << log();

  const std::string objects = readFile(out() + "/objects.json");
  fs::remove(report);
  const auto again = startLongRun();
  again.send(SIGINT);
  EXPECT_EQ(again.wait(), 130);
  EXPECT_EQ(readFile(out() + "/objects.json"), objects) << "it may be a complete one";

  const auto replacing = startLongRun({"--replace"});
  replacing.send(SIGINT);
  EXPECT_EQ(replacing.wait(), 130);
  EXPECT_TRUE(interrupted(report));
}

TEST_F(StoppedPrograms, AnInterruptedLocalisationReplacesACompleteOneOnlyWhenToldTo)
{
  const std::string map = folder_.path("map"), report = out() + "/localization.json",
                    complete = R"({"input":{"interrupted":false}})";
  ASSERT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + map).status, 0);
  fs::create_directory(out());
  folder_.write("out/localization.json", complete);
  const auto interruptRun = [&](const std::vector<std::string>& more)
  {
    std::vector<std::string> arguments{recording("long"), "--map", map, "-o", out()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = start("quadmap-localize", arguments);
    waitUntil([&] { return fs::exists(out() + "/.localization.partial"); });
    run.send(SIGINT);
    EXPECT_EQ(run.wait(), 130) << log();
  };
  interruptRun({});
  EXPECT_EQ(readFile(report), complete);
  EXPECT_TRUE(interrupted(out() + "/interrupted/localization.json"));
  EXPECT_TRUE(fs::exists(out() + "/interrupted/localization.tum"));
  EXPECT_NE(log().find("--replace"), std::string::npos) << log();
  interruptRun({"--replace"});
  EXPECT_TRUE(interrupted(report));
}

TEST_F(StoppedPrograms, SignalsWhileTheResultIsWrittenLoseNothing)
{
  const auto run = startLongRun();
  run.send(SIGINT);
  waitUntil([&] { return bytesIn(out() + "/.results.partial") > 0; });
  for (int i = 0; i < 3; ++i) run.send(SIGINT);
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_TRUE(interrupted(out() + "/report.json"));
  EXPECT_TRUE(fs::exists(out() + "/scene.3Dscene"));
  EXPECT_FALSE(fs::exists(out() + "/.results.partial"));
}

TEST_F(StoppedPrograms, ARunThatIsStoppedBeforeItsFirstImageTellsTheSignal)
{
  for (const int signal : {SIGINT, SIGTERM})
  {
    const auto program = start("quadmap-slam", {recording("long"), "-o", out()});
    waitUntil([&] { return fs::exists(out()); });  // while the program looks through the recording
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal) << log();
    fs::remove_all(out());
  }
}

TEST_F(StoppedPrograms, QuitEndsARunAtOnceWithoutTemporaryFiles)
{
  const auto run = startLongRun();
  run.send(SIGQUIT);
  EXPECT_EQ(run.wait(), 128 + SIGQUIT);
  EXPECT_EQ(folder_.fileCount(), 0u);
}

TEST_F(StoppedPrograms, KilledWhileItWritesARunLeavesTheEarlierResult)
{
  ASSERT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + out()).status, 0);
  const std::string report = readFile(out() + "/report.json"),
                    map = readFile(out() + "/objects.quadmap");
  const auto run = startLongRun({"--replace"});
  run.send(SIGINT);
  waitUntil([&] { return bytesIn(out() + "/.results.partial") > 0; });
  run.send(SIGKILL);
  EXPECT_EQ(run.wait(), 128 + SIGKILL);
  EXPECT_EQ(readFile(out() + "/report.json"), report);
  EXPECT_EQ(readFile(out() + "/objects.quadmap"), map);
  EXPECT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + out()).status, 0);
  EXPECT_FALSE(fs::exists(out() + "/.results.partial")) << "the next run cleans up";
}

TEST_F(StoppedPrograms, EveryReaderRefusesAMixtureOfTwoRunsInOneLine)
{
  ASSERT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + out()).status, 0);
  // What a run leaves that was killed between two of its files.
  fs::create_directory(out() + "/.results.partial");
  std::string list;
  for (const auto* name : {"objects.quadmap", "objects.json", "trajectory.tum", "map.simplemap"})
    list += std::string("+") + name + '\0';
  folder_.write("out/.results.partial/.exchange", list);
  const std::string truth = recordings_->path("short");
  for (const auto& [program, arguments] : std::vector<std::pair<std::string, std::string>>{
           {  "quadmap-export",out() + " --json " + folder_.path("x.json")                               },
           {"quadmap-evaluate", out() + " --objects " + truth + ".objects.gt.json"},
           {"quadmap-evaluate",
            out() + "/trajectory.tum --trajectory " + truth + ".groundtruth.tum"  },
           {     "quadmap-map",               "info " + out() + "/objects.quadmap"},
           {    "quadmap-slam",  recording("short") + " -o " + folder_.path("new") + " --map " + out() +
  "/objects.quadmap"                               }
  })
  {
    const auto result = runProgram(program, arguments);
    EXPECT_EQ(result.status, 1) << program;
    EXPECT_NE(result.err.find("two runs"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_EQ(runProgram("quadmap-slam", recording("short") + " -o " + out()).status, 0);
  EXPECT_EQ(runProgram("quadmap-map", "info " + out() + "/objects.quadmap").status, 0);
}
