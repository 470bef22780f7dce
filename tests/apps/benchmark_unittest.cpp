#include <gtest/gtest.h>

#include <algorithm>

#include "../folders/SampleRecording.h"
#include "RunProgram.h"

using namespace quadmap;

// The benchmark's scripts with the real quadmap-benchmark; the programs that take long are
// stand-ins that note each call and leave files of the right form.
namespace
{
class BenchmarkScripts : public ::testing::Test
{
 protected:
  BenchmarkScripts()
  {
    std::filesystem::create_directory(folder_.path("bin"));
    std::filesystem::create_symlink(
        QUADMAP_BIN_DIR "/quadmap-benchmark", folder_.path("bin/quadmap-benchmark"));
    addProgram("quadmap-simulate", R"(
      while [[ $1 != -o ]]; do shift; done
      touch "$2"
      echo '{"objects": []}' >"${2%.rawlog}.objects.gt.json"
      echo "1 0 0 0 0 0 0 1" >"${2%.rawlog}.groundtruth.tum")");
    addProgram("quadmap-slam", R"(
      while [[ $1 != -o ]]; do shift; done
      mkdir "$2" && cd "$2"
      touch objects.quadmap
      echo '{"objects": []}' >objects.json
      echo "1 0 0 0 0 0 0 1" | tee trajectory.tum >trajectory_odometry.tum
      [[ ! -e $calls.fail ]] || { echo "no such luck" >&2; exit 1; }
      if [[ -e $calls.kill && $(grep -c quadmap-slam "$calls") == 3 ]]; then
        of=$$ processes=()  # those above this one, up to the script `run`
        until ((${#processes[@]})) && grep -qa benchmark/run /proc/${processes[0]}/cmdline; do
          of=$(awk '/^PPid/ {print $2}' /proc/$of/status)
          processes=($of "${processes[@]}")
        done
        kill -KILL "${processes[@]}"
        exit 1
      fi
      echo '{"objects": 0}' >report.json)");
    addProgram("quadmap-evaluate", R"(
      while [[ $1 != --json ]]; do shift; done
      echo '{"trajectory": {"ate_rmse_m": 0.125, "keyframes": 3}, "objects": {}, "matches": []}' >"$2")");
    addProgram("observation_tables", R"(
      while [[ $1 != --json ]]; do shift; done
      echo '{"rows": {}}' >"$2")");
    folder_.write(
        "page.md", "by hand\n<!-- generated: trajectory -->\n<!-- end of trajectory -->\n");
  }

  void addProgram(const std::string& name, const std::string& body)
  {
    const auto path = folder_.write(
        "bin/" + name, "#!/bin/bash\nset -e\ncalls='" + folder_.path("calls") + "'\necho \"" +
                           name + " $*\" >>\"$calls\"\n" + body + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }

  /** \param more Further arguments. */
  ProgramResult run(const std::string& more)
  {
    std::filesystem::remove(folder_.path("calls"));
    return runCommand(
        "QUADMAP_TEST_DATA='" + testData_ +
        "' " QUADMAP_SOURCE_DIR "/share/quadmap/benchmark/run --bin '" + folder_.path("bin") +
        "' --results '" + folder_.path("results") + "' --page '" + folder_.path("page.md") +
        "' --jobs 2 " + more);
  }

  std::size_t calls(const std::string& program) const
  {
    const std::string text = readFile(folder_.path("calls"));
    std::size_t count = 0;
    for (auto at = text.find(program + " "); at != kNotFound; at = text.find(program + " ", at + 1))
      ++count;
    return count;
  }

  bool isDone(const std::string& job) const
  {
    return std::filesystem::exists(folder_.path("results/runs/" + job + "/job.txt"));
  }

  /** Folders of results, and what unfinished jobs have left. */
  std::size_t folders() const
  {
    const std::filesystem::directory_iterator runs(folder_.path("results/runs"));
    return static_cast<std::size_t>(std::distance(begin(runs), end(runs)));
  }

  TemporaryFolder folder_;
  std::string testData_;  //!< Folder with recordings; none
};
}  // namespace

TEST_F(BenchmarkScripts, DoEveryJobAndFillThePage)
{
  const auto result = run("--scenes home --seeds 1,2 --methods odometry,rgbd");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(calls("quadmap-slam"), 2u * 3) << "odometry; rgbd on two kinds of poses";
  EXPECT_GE(calls("quadmap-simulate"), 2u);
  EXPECT_EQ(calls("observation_tables"), 2u * 4);
  EXPECT_EQ(folders(), 6u + 8u);
  EXPECT_TRUE(isDone("simulated.home.2.rgbd.ground-truth"));
  const std::string page = readFile(folder_.path("page.md"));
  EXPECT_NE(page.find("| home | drifting odometry | 3 +- 0 | - | 0.125 +- 0.000 |"), kNotFound)
      << page;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("results/recordings"))) << "large, done with";
}

TEST_F(BenchmarkScripts, DoNothingTwice)
{
  const std::string plan = "--scenes home --seeds 1 --methods rgbd";
  ASSERT_EQ(run(plan).status, 0);
  const std::string page = readFile(folder_.path("page.md"));
  ASSERT_EQ(run(plan).status, 0);
  EXPECT_EQ(readFile(folder_.path("calls")), "");
  EXPECT_EQ(readFile(folder_.path("page.md")), page);
  ASSERT_EQ(run("--scenes home --seeds 1,7 --methods rgbd").status, 0);
  EXPECT_EQ(calls("quadmap-slam"), 2u) << "the new seed only";
}

TEST_F(BenchmarkScripts, GoOnAfterAFailureAndTryItAgain)
{
  const std::string plan = "--scenes home --observed home --seeds 1 --methods rgbd";
  folder_.write("calls.fail", "");
  const auto failed = run(plan);
  EXPECT_EQ(failed.status, 1);
  EXPECT_NE(failed.err.find("failed: simulated home 1 rgbd rawlog"), kNotFound) << failed.err;
  EXPECT_NE(failed.err.find("no result of: simulated home 1 rgbd rawlog"), kNotFound);
  EXPECT_EQ(calls("observation_tables"), 4u) << "the others go on";
  EXPECT_EQ(folders(), 4u) << "nothing is left of what failed";
  EXPECT_NE(
      readFile(folder_.path("results/logs/simulated.home.1.rgbd.rawlog.log")).find("no such luck"),
      kNotFound);

  std::filesystem::remove(folder_.path("calls.fail"));
  const auto again = run(plan);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(calls("quadmap-slam"), 2u);
  EXPECT_EQ(calls("observation_tables"), 0u);
  EXPECT_EQ(calls("quadmap-simulate"), 0u) << "the recording is still there";
}

TEST_F(BenchmarkScripts, GoOnAfterTheyWereKilled)
{
  const std::string plan = "--scenes home --observed '' --seeds 1,2,3 --methods rgbd --jobs 1";
  const std::string page = readFile(folder_.path("page.md"));
  folder_.write("calls.kill", "");
  EXPECT_NE(run(plan).status, 0);
  EXPECT_EQ(calls("quadmap-slam"), 3u);
  EXPECT_EQ(folders(), 3u) << "two results, and what the third job was at";
  EXPECT_EQ(readFile(folder_.path("page.md")), page);

  std::filesystem::remove(folder_.path("calls.kill"));
  const auto again = run(plan);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(calls("quadmap-slam"), 6u - 2u) << "what was done is not done again";
  EXPECT_EQ(folders(), 6u) << "nothing is left of what was killed";
  EXPECT_FALSE(std::filesystem::exists(folder_.path("results/recordings")));
}

TEST_F(BenchmarkScripts, MapAsManyRandomRoomsAsWanted)
{
  const std::string plan = "--observed '' --seeds 1 --methods rgbd --list";
  const auto lines = [](const ProgramResult& list)
  { return std::count(list.out.begin(), list.out.end(), '\n'); };
  EXPECT_EQ(lines(run("--scenes home " + plan)), 2) << "none unless asked for";
  const auto list = run("--scenes home --rooms 3 " + plan);
  EXPECT_EQ(lines(list), 2 + 2 * 3) << list.out << list.err;
  EXPECT_NE(list.out.find("simulated random 3 rgbd rawlog\n"), kNotFound);
  EXPECT_NE(run(plan).out.find("simulated random 20 rgbd rawlog\n"), kNotFound) << "all";
  EXPECT_NE(run("--rooms some " + plan).status, 0);
}

TEST_F(BenchmarkScripts, ListTheJobsForAnotherScheduler)
{
  const auto list = run("--scenes home --observed home --seeds 3 --methods rgbd,magic --list");
  ASSERT_EQ(list.status, 0) << list.err;
  EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '\n'), 2 + 4);
  EXPECT_EQ(readFile(folder_.path("results/jobs.txt")), list.out);
  EXPECT_NE(list.err.find("no method magic"), kNotFound) << list.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("calls")));

  // Line 2 as an element of a Slurm array does it.
  const std::string scripts = QUADMAP_SOURCE_DIR "/share/quadmap/benchmark";
  const auto element = runCommand(
      "PATH='" + folder_.path("bin") + "':$PATH SLURM_ARRAY_TASK_ID=2 BENCHMARK=" + scripts +
      " QUADMAP_BENCHMARK_RESULTS='" + folder_.path("results") + "' bash " + scripts +
      "/slurm.sbatch");
  ASSERT_EQ(element.status, 0) << element.err;
  EXPECT_EQ(folders(), 1u);
  EXPECT_TRUE(isDone("simulated.home.3.rgbd.ground-truth"));
}

TEST_F(BenchmarkScripts, AListWhileTheyRunTakesNoJobFromThem)
{
  // The first scene that is simulated asks for a list of other jobs.
  addProgram(
      "quadmap-simulate",
      "while [[ $1 != -o ]]; do shift; done\n"
      "touch \"$2\"\n"
      "echo '{\"objects\": []}' >\"${2%.rawlog}.objects.gt.json\"\n"
      "echo '1 0 0 0 0 0 0 1' >\"${2%.rawlog}.groundtruth.tum\"\n"
      "mkdir '" +
          folder_.path("asked") +
          "' 2>/dev/null || exit 0\n" QUADMAP_SOURCE_DIR "/share/quadmap/benchmark/run --bin '" +
          folder_.path("bin") + "' --results '" + folder_.path("results") +
          "' --scenes approach,office --seeds 11,12,13 --list >/dev/null");
  const auto result = run("--scenes home --seeds 1,2,3,4 --methods odometry,rgbd --observed ''");
  ASSERT_EQ(result.status, 0) << result.err;
  ASSERT_TRUE(std::filesystem::exists(folder_.path("asked")));
  EXPECT_EQ(folders(), 4u * 3);
  EXPECT_TRUE(isDone("simulated.home.4.rgbd.ground-truth"));
  EXPECT_EQ(result.err.find("no result of"), kNotFound) << result.err;
}

TEST_F(BenchmarkScripts, AJobNeedsNothingButTheFolderOfItsResults)
{
  const SampleRecording recording;
  recording.files.write("rgb.txt", "");
  std::filesystem::create_directory(folder_.path("data"));
  std::filesystem::create_symlink(recording.folder(), folder_.path("data/sample"));
  addProgram("quadmap-import", "while [[ $1 != -o ]]; do shift; done; touch \"$2\"");
  testData_ = folder_.path("data");
  ASSERT_EQ(run("--scenes home --seeds 1 --methods rgbd --resolution 640x480 --list").status, 0);

  const auto doesIt = [&](const std::string& job)
  {
    const auto result = runCommand(
        "env -i PATH='" + folder_.path("bin") + "':\"$PATH\" QUADMAP_BENCHMARK_RESULTS='" +
        folder_.path("results") + "' " QUADMAP_SOURCE_DIR "/share/quadmap/benchmark/job '" + job +
        "'");
    EXPECT_EQ(result.status, 0) << job << ": " << result.err;
  };
  doesIt("simulated home 1 rgbd rawlog");
  doesIt("observed home 1 edges ground-truth");
  doesIt("recorded sample 0 rgbd rawlog");
  EXPECT_EQ(folders(), 3u);
  const std::string done = readFile(folder_.path("calls"));
  EXPECT_NE(done.find("quadmap-simulate home --seed 1 --resolution 640x480"), kNotFound) << done;
  EXPECT_NE(done.find("--resolution 640x480 --json"), kNotFound) << done;
  EXPECT_NE(done.find("quadmap-import tum " + testData_ + "/sample"), kNotFound) << done;
}

TEST_F(BenchmarkScripts, RefuseAFolderOfAnotherResolutionAndMissingData)
{
  const std::string plan = "--scenes home --observed '' --seeds 1 --methods rgbd --list ";
  ASSERT_EQ(run(plan).status, 0);
  const auto other = run(plan + "--resolution 640x480");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find(" at 320x240, and this is "), kNotFound) << other.err;
  EXPECT_EQ(run(plan).status, 0);

  testData_ = folder_.path("nowhere");
  const auto missing = run(plan);
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("no folder " + testData_), kNotFound) << missing.err;
}

TEST_F(BenchmarkScripts, MergeKeepsThePicturesOfThePageUnlessItMakesNew)
{
  const std::string pictures =
      "<!-- generated: pictures -->\n![a](a.svg)\n<!-- end of pictures -->\n";
  ASSERT_EQ(run("--scenes home --observed '' --seeds 1 --methods rgbd").status, 0);
  folder_.write("page.md", pictures);
  const std::string merge =
      "merge '" + folder_.path("results") + "' --page '" + folder_.path("page.md") + "'";
  ASSERT_EQ(runProgram("quadmap-benchmark", merge).status, 0);
  EXPECT_EQ(readFile(folder_.path("page.md")), pictures);
  ASSERT_EQ(
      runProgram("quadmap-benchmark", merge + " --plots '" + folder_.path("plots") + "'").status,
      0);
  EXPECT_EQ(readFile(folder_.path("page.md")).find("![a]"), kNotFound);
  EXPECT_TRUE(std::filesystem::exists(folder_.path("plots/classes-trans.svg")));
}

TEST_F(BenchmarkScripts, MergeWritesPageAndPlotsOrNothing)
{
  ASSERT_EQ(run("--scenes home --observed '' --seeds 1 --methods rgbd").status, 0);
  folder_.write("page.md", "<!-- generated: pictures -->\n");
  const std::string merge =
      "merge '" + folder_.path("results") + "' --plots '" + folder_.path("plots") + "' --page '";
  EXPECT_EQ(runProgram("quadmap-benchmark", merge + folder_.path("page.md") + "'").status, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("plots")));
}

TEST_F(BenchmarkScripts, MapRecordingsWithWhatTruthThereIs)
{
  const SampleRecording recording;
  std::filesystem::create_directory(folder_.path("data"));
  std::filesystem::create_symlink(recording.folder(), folder_.path("data/sample"));
  recording.files.write("rgb.txt", "");
  std::filesystem::create_symlink(
      QUADMAP_BIN_DIR "/quadmap-import", folder_.path("bin/quadmap-import"));
  const auto evaluation = [&](const std::string& job)
  { return readFile(folder_.path("results/runs/recorded.sample." + job + "/evaluation.json")); };
  const std::string plan = "--scenes '' --observed '' --seeds 1 --methods odometry,rgbd";

  testData_ = folder_.path("data");
  const auto known = run(plan);
  ASSERT_EQ(known.status, 0) << known.err;
  EXPECT_EQ(calls("quadmap-evaluate"), calls("quadmap-slam")) << "groundtruth.txt is there";
  EXPECT_GT(calls("quadmap-slam"), 2u);
  EXPECT_NE(evaluation("0.rgbd.rawlog").find("0.125"), kNotFound);

  std::filesystem::remove_all(folder_.path("results"));
  std::filesystem::remove(recording.files.path("groundtruth.txt"));
  recording.files.write("objects_gt.json", "{\"objects\": []}");
  const auto unknown = run(plan);
  EXPECT_EQ(unknown.status, 0) << "nothing asks for poses that are not there: " << unknown.err;
  EXPECT_NE(evaluation("0.odometry.visual").find("\"trajectory\": null"), kNotFound);
  EXPECT_NE(evaluation("0.rgbd.visual").find("0.125"), kNotFound) << "compared with the objects";
  EXPECT_EQ(calls("quadmap-slam"), 2u);
  EXPECT_EQ(calls("quadmap-evaluate"), 1u) << "odometry has no objects";

  std::filesystem::remove_all(folder_.path("results"));
  std::filesystem::rename(
      recording.files.path("objects_gt.json"), recording.files.path("objects.gt.json"));
  ASSERT_EQ(run(plan).status, 0);
  EXPECT_NE(evaluation("0.rgbd.visual").find("0.125"), kNotFound) << "either name is known";
}

/** A source tree under git: the scripts, a page with a marker, and a file that stands for the code.
 */
class BenchmarkOfATree : public BenchmarkScripts
{
 protected:
  static constexpr const char* kEmptyPage =
      "<!-- generated: trajectory -->\n<!-- end of trajectory -->\n";

  void SetUp() override
  {
    if (runCommand("git --version").status != 0) GTEST_SKIP() << "no git";
    namespace fs = std::filesystem;
    fs::create_directories(folder_.path("tree/share/quadmap"));
    fs::create_directories(folder_.path("tree/doc"));
    fs::copy(
        QUADMAP_SOURCE_DIR "/share/quadmap/benchmark", folder_.path("tree/share/quadmap/benchmark"),
        fs::copy_options::recursive);
    folder_.write("tree/CMakePresets.json", "{}");
    folder_.write("tree/.gitignore", "/build/\n");
    folder_.write("tree/code", "first");
    folder_.write("tree/doc/benchmarks.md", kEmptyPage);
    git("init -q");
    git("add -A");
    git("-c user.name=n -c user.email=n@n commit -qm first");
  }
  void git(const std::string& arguments)
  {
    const auto result = runCommand("git -C '" + folder_.path("tree") + "' " + arguments);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  static constexpr const char* kPart = "--scenes home --observed '' --seeds 1 --methods rgbd";

  /** \param more Further arguments. */
  ProgramResult runTree(const std::string& more)
  {
    std::filesystem::remove(folder_.path("calls"));
    return runCommand(
        "QUADMAP_TEST_DATA= '" + folder_.path("tree/share/quadmap/benchmark/run") + "' --bin '" +
        folder_.path("bin") + "' " + more);
  }
  std::string page() const { return folder_.path("tree/doc/benchmarks.md"); }
  std::size_t resultFolders() const
  {
    const std::filesystem::directory_iterator kept(folder_.path("tree/build/benchmark"));
    return static_cast<std::size_t>(std::distance(begin(kept), end(kept)));
  }
};

TEST_F(BenchmarkOfATree, KeepsTheResultsOfEveryStateApart)
{
  const std::string part = std::string(kPart) + " --page '" + page() + "'";
  const auto first = runTree(part);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(calls("quadmap-slam"), 2u);
  const std::string folder =
      std::filesystem::directory_iterator(folder_.path("tree/build/benchmark"))->path().string();
  EXPECT_EQ(folder.find("dirty"), kNotFound);

  ASSERT_NE(readFile(page()), kEmptyPage);
  ASSERT_EQ(runTree(part).status, 0);
  EXPECT_EQ(calls("quadmap-slam"), 0u) << "the page it wrote is no change";
  EXPECT_EQ(resultFolders(), 1u);

  for (const char* code : {"second", "third"})
  {
    folder_.write("tree/code", code);
    ASSERT_EQ(runTree(part).status, 0);
    EXPECT_EQ(calls("quadmap-slam"), 2u) << code;
  }
  EXPECT_EQ(resultFolders(), 3u);

  const auto mixed = runTree(part + " --results '" + folder + "'");
  EXPECT_EQ(mixed.status, 1);
  EXPECT_NE(mixed.err.find("has results of"), kNotFound) << mixed.err;
  EXPECT_EQ(std::count(mixed.err.begin(), mixed.err.end(), '\n'), 1);
}

TEST_F(BenchmarkOfATree, WritesItsPageWhenEverythingWasRun)
{
  const auto part = runTree(kPart);
  ASSERT_EQ(part.status, 0) << part.err;
  EXPECT_EQ(readFile(page()), kEmptyPage);
  EXPECT_NE(part.out.find("| home | drifting odometry |"), kNotFound) << "printed: " << part.out;

  // One job of all is done indeed, the others come out as missing.
  const auto job = folder_.write(
      "tree/share/quadmap/benchmark/job",
      "#!/bin/bash\n[[ $1 != 'simulated home 1 rgbd rawlog' ]] || exec " QUADMAP_SOURCE_DIR
      "/share/quadmap/benchmark/job \"$1\"\n");
  std::filesystem::permissions(job, std::filesystem::perms::owner_all);
  const auto whole = runTree("");
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_NE(readFile(page()).find("| home | drifting odometry |"), kNotFound) << readFile(page());
}

TEST_F(BenchmarkScripts, AnswerWrongUsageWithStatus2)
{
  EXPECT_EQ(run("--sceens home").status, 2);
  EXPECT_EQ(run("--scenes").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "jobs --seeds one").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "jobs --seeds 1,,2").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "jobs --scenes home,office,home").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "jobs --methods rgbd,").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "merge").status, 2);
  EXPECT_EQ(runProgram("quadmap-benchmark", "").status, 2);
  const auto nothing = runProgram("quadmap-benchmark", "merge /nonexistent");
  EXPECT_EQ(nothing.status, 1);
  EXPECT_NE(nothing.err.find("/nonexistent"), kNotFound) << nothing.err;
}
