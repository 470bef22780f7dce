#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "../obs/TemporaryFolder.h"
#include "MeanAndSpread.h"
#include "quadmap/benchmark/BenchmarkPlots.h"
#include "quadmap/benchmark/BenchmarkTables.h"
#include "quadmap/benchmark/GeneratedSections.h"

using namespace quadmap;

namespace
{
BenchmarkPlan smallPlan()
{
  return {
      {     "home", "office" },
      {     "home"         },
      {"kitchen_a"         },
      {          1,        2},
      { "odometry",   "rgbd"}
  };
}

/** A folder of results that is made by hand. */
class Results : public ::testing::Test
{
 protected:
  void add(const std::string& line, const std::map<std::string, std::string>& files)
  {
    const std::string name = "runs/" + BenchmarkJob::fromLine(line).folder();
    std::filesystem::create_directories(folder_.path(name));
    folder_.write(name + "/job.txt", line + "\n");
    folder_.write(name + "/machine.json", R"({"processor": "abacus", "commit": "c0ffee"})");
    for (const auto& [file, content] : files) folder_.write(name + "/" + file, content);
  }

  void addRun(const std::string& line, double ate, double trans)
  {
    add(line,
        {
            {"evaluation.json",
             R"({"trajectory": {"ate_rmse_m": )" + std::to_string(ate) +
             R"(, "ate_rmse_odometry_m": 0.5, "keyframes": 10}, "objects": {"truth": 4,
              "estimated": 2, "matched": 2, "precision": 1.0, "recall": 0.5, "f1": 0.667,
              "trans_m": )" +
             std::to_string(trans) +
             R"(, "rot_deg": 3.0, "shape_iou": 0.8, "iou_3d": null},
              "matches": [{"truth_id": 1, "id": 2, "label": "chair", "trans_m": 0.1, "rot_deg": 3.0}]})"                    },
            { "report.json", R"({"objects": 2, "timing": {"cpu_total_s": 4.0, "peak_memory_mb": 99.0,
            "modules": {"map": {"calls": 7, "cpu_mean_ms": 2.5, "cpu_p95_ms": 5.0},
                        "odometry": {"calls": 7, "cpu_mean_ms": 0.004, "cpu_p95_ms": 0.04},
                        "write x": {"calls": 1, "cpu_mean_ms": 1.0, "cpu_p95_ms": 1.0}}}})"},
            { "objects.quadmap",                                                         std::string(3000,                                                                     'x')},
            { "objects.json",                                                         std::string(1000,                                                                     'x')}
    });
  }

  std::map<std::string, std::string> tables()
  {
    return benchmarkTables(readBenchmarkResults(folder_.folder().string()));
  }

  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST(MeanAndSpread, IsThatOfASample)
{
  MeanAndSpread values;
  EXPECT_EQ(values.text(2), "-");
  values.add(2);
  values.add(std::nullopt);
  EXPECT_EQ(values.text(1), "2.0");
  EXPECT_FALSE(values.deviation());
  values.add(4);
  values.add(6);
  EXPECT_EQ(values.count(), 3u);
  EXPECT_EQ(values.text(1), "4.0 +- 2.0");
}

TEST(BenchmarkJobs, AreEveryCombinationOnceAndFirstTheFirstSeed)
{
  const auto jobs = jobsOf(smallPlan());
  std::set<std::string> lines, folders;
  for (const auto& job : jobs)
  {
    lines.insert(job.line());
    folders.insert(job.folder());
    EXPECT_EQ(BenchmarkJob::fromLine(job.line()).line(), job.line());
  }
  EXPECT_EQ(lines.size(), jobs.size());
  EXPECT_EQ(folders.size(), jobs.size());
  // Recording: rgbd three ways, odometry two. Scenes and seeds: rgbd two ways, odometry one. Four
  // tables of one scene.
  EXPECT_EQ(jobs.size(), 5u + 2 * (2 * 3 + 4));
  EXPECT_TRUE(lines.count("recorded kitchen_a 0 rgbd visual"));
  EXPECT_TRUE(lines.count("simulated office 2 rgbd ground-truth"));
  EXPECT_TRUE(lines.count("observed home 1 ablation ground-truth"));
  EXPECT_FALSE(lines.count("simulated home 1 odometry ground-truth")) << "nothing to find out";
  const auto seed2 = [](const BenchmarkJob& job) { return job.seed == 2; };
  EXPECT_TRUE(std::is_partitioned(jobs.begin(), jobs.end(), std::not_fn(seed2)));
}

TEST(BenchmarkJobs, MapEachRandomRoomOnce)
{
  BenchmarkPlan plan = smallPlan();
  const auto without = jobsOf(plan).size();
  plan.rooms = 20;
  const auto jobs = jobsOf(plan);
  ASSERT_EQ(jobs.size(), without + 2 * 20);
  EXPECT_EQ(jobs[without].line(), "simulated random 1 rgbd rawlog");
  EXPECT_EQ(jobs.back().line(), "simulated random 20 rgbd ground-truth");
  plan.methods = {"odometry"};
  for (const auto& job : jobsOf(plan)) EXPECT_NE(job.subject, "random");
}

TEST(BenchmarkJobs, RefuseWhatBreaksLinesAndFolders)
{
  for (const char* name : {"my scene", "scenes/home", "a.b", ""})
  {
    BenchmarkPlan plan = smallPlan();
    plan.scenes = {name};
    EXPECT_THROW(jobsOf(plan), std::invalid_argument) << name;
  }
  for (const char* line :
       {"", "simulated home 1 rgbd", "simulated home one rgbd rawlog", "drawn home 1 rgbd rawlog",
        "simulated home 1 rgbd rawlog more"})
    EXPECT_THROW(BenchmarkJob::fromLine(line), std::invalid_argument) << line;
}

TEST(GeneratedSections, ReplacesOnlyWhatIsBetweenTheMarkers)
{
  const std::string page =
      "# By hand\n<!-- generated: a -->\nold\n<!-- end of a -->\nby hand\n"
      "<!-- generated: b -->\n<!-- end of b -->\n";
  const std::string expected =
      "# By hand\n<!-- generated: a -->\nnew\n<!-- end of a -->\nby hand\n"
      "<!-- generated: b -->\nB\n<!-- end of b -->\n";
  const std::map<std::string, std::string> sections{
      {"a",  "new\n"},
      {"b",    "B\n"},
      {"c", "unused"}
  };
  EXPECT_EQ(withGeneratedSections(page, sections), expected);
  EXPECT_EQ(withGeneratedSections(expected, sections), expected);
  EXPECT_EQ(withGeneratedSections("no markers", sections), "no markers");
}

TEST(GeneratedSections, NamesTheSectionThatIsWrong)
{
  const auto error = [](const std::string& page)
  {
    return errorOf(
        [&]
        {
          withGeneratedSections(
              page, {
                        {"a", ""}
          });
        });
  };
  EXPECT_TRUE(contains(error("<!-- generated: a -->\n"), "no <!-- end of a -->"));
  EXPECT_TRUE(contains(error("<!-- generated: z -->\n<!-- end of z -->"), "section z"));
  EXPECT_FALSE(error("<!-- generated: a").empty());
}

TEST_F(Results, AreMeansAndSpreadsOverSeeds)
{
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  addRun("simulated home 2 rgbd rawlog", 0.014, 0.04);
  addRun("simulated home 1 rgbd ground-truth", 0, 0.01);
  addRun("simulated home 1 odometry rawlog", 0.5, 0.01);
  const auto t = tables();
  EXPECT_TRUE(
      contains(t.at("trajectory"), "| home | drifting odometry | 10 | 0.500 | 0.012 +- 0.003 |"))
      << t.at("trajectory");
  EXPECT_FALSE(contains(t.at("trajectory"), "given")) << "true poses have no error";
  EXPECT_TRUE(contains(
      t.at("mapping"),
      "| home | drifting odometry | rgbd | 2 | 0.030 +- 0.014 | 3.00 +- 0.00 | 0.800 +- 0.000 | - "
      "|"))
      << t.at("mapping");
  EXPECT_TRUE(contains(t.at("mapping"), "| home | given | rgbd | 1 | 0.010 |"));
  EXPECT_FALSE(contains(t.at("mapping"), "| odometry |")) << "has no objects";
  EXPECT_TRUE(contains(
      t.at("instantiation"),
      "| home | given | rgbd | 1 | 4.0 | 2.0 | 2.0 | 1.000 | 0.500 | 0.667 |"))
      << t.at("instantiation");
  EXPECT_TRUE(contains(t.at("time"), "2.5 +- 0.0, 5.0 +- 0.0")) << t.at("time");
  EXPECT_FALSE(contains(t.at("time"), "write x"));
  EXPECT_FALSE(contains(t.at("time"), "| odometry |")) << "would be zero throughout";
  EXPECT_TRUE(contains(t.at("size"), "| home | 2.0 +- 0.0 | 1.50 +- 0.00 | 0.50 +- 0.00 |"))
      << t.at("size");
  EXPECT_TRUE(contains(t.at("machine"), "| processor | abacus |"));
  EXPECT_TRUE(contains(t.at("machine"), "| seeds | 1; 2 |"));
}

TEST_F(Results, OfRandomRoomsHaveTheirSpreadOverRooms)
{
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  addRun("simulated random 1 rgbd rawlog", 0.010, 0.02);
  addRun("simulated random 7 rgbd rawlog", 0.014, 0.04);
  const auto t = tables();
  EXPECT_TRUE(
      contains(t.at("mapping"), "| random | drifting odometry | rgbd | 2 | 0.030 +- 0.014 |"))
      << t.at("mapping");
  EXPECT_TRUE(contains(t.at("machine"), "| random rooms | 2 |")) << t.at("machine");
  EXPECT_TRUE(contains(t.at("machine"), "| seeds | 1 |")) << "those of the other scenes";
  EXPECT_TRUE(contains(t.at("machine"), "| scenes | home |"));
}

TEST_F(Results, TellTheTimeOfVisualOdometry)
{
  addRun("recorded kitchen_a 0 rgbd rawlog", 0.010, 0.02);
  addRun("recorded kitchen_a 0 rgbd visual", 0.010, 0.02);
  folder_.write("runs/recorded.kitchen_a.0.rgbd.visual/report.json", R"({"objects": 2, "timing":
    {"modules": {"odometry": {"calls": 7, "cpu_mean_ms": 21.5, "cpu_p95_ms": 30.0}}}})");
  const std::string time = tables().at("time");
  EXPECT_TRUE(contains(time, "| poses | map | odometry |")) << time;
  EXPECT_TRUE(contains(time, "| kitchen_a | recorded, corrected | 2.5, 5.0 | 0.0, 0.0 |")) << time;
  EXPECT_TRUE(contains(time, "| kitchen_a | from the images | -, - | 21.5, 30.0 |")) << time;
}

TEST_F(Results, OfObservationsAreAddedUp)
{
  for (const char* seed : {"1", "2"})
  {
    const auto line = [&](const std::string& table)
    { return "observed home " + std::string(seed) + " " + table + " ground-truth"; };
    const double trans = seed == std::string("1") ? 0.01 : 0.03;
    add(line("ablation"),
        {
            {"observation.json",
             R"({"rows": {"both": {"trans_m": )" + std::to_string(trans) + R"(, "f1": 1.0}}})"}
    });
    const std::string usable = seed == std::string("1") ? "8" : "10";
    add(line("edges"), {
                           {"observation.json", R"({"rows": {"all / both":
        {"good": 10, "invalid": 5, "usable_invalid": 0, "usable_good": )" +
 usable + "}}}"}
    });
    // Two residuals of +1 and -1 sigma within three: variance 1 / 0.9733.
    add(line("residuals"), {
                               {"observation.json", R"({"rows": {"yaw": {"count": 4, "beyond": 2,
        "inside": 2, "sum": 0, "squares": 2}, "at least: side": {"count": 4, "beyond": 1}}})"}
    });
    add(line("orientation"),
        {
            {"observation.json", R"({"rows": {"chair": {"count": 5, "sum_deg": 10}}})"}
    });
  }
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  const auto t = tables();
  EXPECT_TRUE(contains(t.at("ablation"), "| home, 2 seeds |"));
  EXPECT_TRUE(contains(t.at("ablation"), "| both | 0.020 +- 0.014 | - |")) << t.at("ablation");
  EXPECT_TRUE(
      contains(t.at("edges"), "| home | all | both | 20 | 10 | 1.000 +- 0.000 | 0.900 +- 0.141 |"))
      << t.at("edges");
  EXPECT_TRUE(contains(t.at("residuals"), "| yaw | 0.00, 1.03, 50 % (8) |")) << t.at("residuals");
  EXPECT_TRUE(contains(t.at("residuals"), "| at least: side | violated 25 % (8) |"));
  EXPECT_TRUE(contains(t.at("orientation"), "| chair | 2.00 (10) | - | 3.00 (1) |"))
      << t.at("orientation");
}

TEST_F(Results, SayWhatIsMissingAndIgnoreUnfinishedWork)
{
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  std::filesystem::create_directories(folder_.path("runs/.work-a1b2"));
  folder_.write("jobs.txt", "simulated home 1 rgbd rawlog\nsimulated home 2 rgbd rawlog\n");
  const auto results = readBenchmarkResults(folder_.folder().string());
  EXPECT_EQ(results.done.size(), 1u);
  EXPECT_EQ(results.missing, std::vector<std::string>{"simulated home 2 rgbd rawlog"});
  EXPECT_TRUE(contains(benchmarkTables(results).at("machine"), "1 done, 1 missing"));
}

TEST_F(Results, NameTheFileThatIsBroken)
{
  const auto error = [&]
  { return errorOf([&] { readBenchmarkResults(folder_.folder().string()); }); };
  EXPECT_TRUE(contains(error(), "no results"));
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  folder_.write("runs/simulated.home.1.rgbd.rawlog/report.json", "{");
  EXPECT_TRUE(contains(error(), "report.json")) << error();
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  for (const char* text : {"7", "{}", R"({"matches": [{}]})"})
  {
    const auto path = folder_.write("runs/simulated.home.1.rgbd.rawlog/evaluation.json", text);
    EXPECT_EQ(error(), path + ": its \"matches\" are not those of quadmap-evaluate") << text;
  }
  add("observed home 1 ablation ground-truth", {
                                                   {"observation.json", "7"}
  });
  EXPECT_TRUE(contains(error(), "observation.json: has no \"rows\"")) << error();
}

TEST_F(Results, SayOnWhichMachineTheyWereMade)
{
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  for (const char* text :
       {"{}", "[]", "null", "7", R"({"format": 1, "processor": "abacus"})", R"({"processor": 8})",
        R"({"format": "quadmap-machine", "version": 2, "processor": "abacus"})"})
  {
    folder_.write("runs/simulated.home.1.rgbd.rawlog/machine.json", text);
    const auto error = errorOf([&] { readBenchmarkResults(folder_.folder().string()); });
    EXPECT_TRUE(contains(error, "rawlog/machine.json: ")) << text << error;
  }
}

TEST_F(Results, OfDifferentCommitsAreNotMixed)
{
  addRun("simulated home 1 rgbd rawlog", 0.010, 0.02);
  addRun("simulated home 2 rgbd rawlog", 0.010, 0.02);
  folder_.write(
      "runs/simulated.home.2.rgbd.rawlog/machine.json",
      R"({"processor": "abacus", "commit": "decade"})");
  const auto error = errorOf([&] { readBenchmarkResults(folder_.folder().string()); });
  EXPECT_TRUE(contains(error, "different commits (c0ffee, decade)")) << error;
  EXPECT_FALSE(contains(error, "\n")) << error;
}

TEST(BenchmarkPlots, ErrorOverTimeIsThatAfterAlignment)
{
  // Right but for the world and one pose of twenty: its error is the only one that stands out.
  Trajectory truth, estimated;
  for (int i = 0; i < 20; ++i)
  {
    truth.push_back({10.0 + i, mrpt::poses::CPose3D(std::cos(i), std::sin(i), 0.1 * i, 0, 0, 0)});
    estimated.push_back({10.0 + i, mrpt::poses::CPose3D(5, 5, 5, 1, 0, 0) + truth.back().pose});
  }
  estimated[7].pose.z_incr(0.5);
  const std::string svg = errorOverTimePlot(
                              "t", truth,
                              {
                                  {"odometry", estimated}
  })
                              .svg;
  const auto at = svg.find("<polyline points=\"") + 18;
  std::vector<double> heights;
  double x = 0, y = 0;
  int n = 0;
  for (const char* p = svg.c_str() + at; std::sscanf(p, "%lf,%lf %n", &x, &y, &n) == 2; p += n)
    heights.push_back(y);
  ASSERT_EQ(heights.size(), 20u);
  EXPECT_EQ(std::min_element(heights.begin(), heights.end()) - heights.begin(), 7);
}
