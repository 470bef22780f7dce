#include <mrpt/core/format.h>

#include <set>

#include "MarkdownTable.h"
#include "MeanAndSpread.h"

namespace quadmap
{
namespace
{
const char* const kPoses[] = {"rawlog", "visual", "ground-truth"};

std::string posesText(const BenchmarkJob& job)
{
  if (job.poses == "visual") return "from the images";
  if (job.poses == "ground-truth") return "given";
  return job.kind == BenchmarkKind::Recorded ? "recorded, corrected" : "drifting odometry";
}

/** The runs of one scene or recording with one method, over all random seeds. */
struct Group
{
  std::vector<const BenchmarkResult*> runs;

  std::string text(const std::string& figure, int decimals) const
  {
    MeanAndSpread values;
    for (const auto* run : runs) values.add(run->figure(figure));
    return values.text(decimals);
  }
  /** A figure of report.json. \param scale Factor for another unit. */
  MeanAndSpread reported(const std::string& figure, double scale = 1) const
  {
    MeanAndSpread values;
    for (const auto* run : runs)
      if (const auto found = run->report.find(figure); found != run->report.end())
        values.add(found->second * scale);
    return values;
  }
  const BenchmarkJob& job() const { return runs.front()->job; }
};

/** All groups: simulated ones before recorded ones, by name, then by poses, then by method. */
std::vector<Group> groupsOf(const BenchmarkResults& results)
{
  std::vector<Group> groups;
  for (const auto kind : {BenchmarkKind::Simulated, BenchmarkKind::Recorded})
    for (const auto& subject : valuesOf(
             results, &BenchmarkJob::subject, [&](const auto& job) { return job.kind == kind; }))
      for (const auto* poses : kPoses)
        for (const auto& method : results.methods())
        {
          Group group;
          for (const auto& run : results.done)
            if (run.job.kind == kind && run.job.subject == subject && run.job.poses == poses &&
                run.job.method == method)
              group.runs.push_back(&run);
          if (!group.runs.empty()) groups.push_back(std::move(group));
        }
  return groups;
}

/** The groups that map objects whose truth is known. */
std::vector<Group> mappingGroups(const BenchmarkResults& results)
{
  std::vector<Group> groups;
  for (auto& group : groupsOf(results))
    if (group.job().method != "odometry" && group.runs.front()->figure("objects.truth"))
      groups.push_back(std::move(group));
  return groups;
}

/** One column of a table with a row per group. */
struct Column
{
  const char *title, *figure;
  int decimals;
};

std::string figuresTable(const std::vector<Group>& groups, const std::vector<Column>& columns)
{
  std::vector<std::string> heading{"", "poses", "method", "runs"};
  for (const auto& column : columns) heading.emplace_back(column.title);
  MarkdownTable table(heading);
  for (const auto& group : groups)
  {
    std::vector<std::string> row{
        group.job().subject, posesText(group.job()), group.job().method,
        std::to_string(group.runs.size())};
    for (const auto& column : columns) row.push_back(group.text(column.figure, column.decimals));
    table.add(row);
  }
  return table.text();
}

/** The groups of method rgbd, with one of these sources of poses. */
std::vector<Group> rgbdGroups(const BenchmarkResults& results, const std::set<std::string>& poses)
{
  std::vector<Group> groups;
  for (auto& group : groupsOf(results))
    if (group.job().method == "rgbd" && poses.count(group.job().poses))
      groups.push_back(std::move(group));
  return groups;
}

/** CPU time of a module per frame [ms]. */
struct ModuleTime
{
  MeanAndSpread mean, p95;

  ModuleTime(const Group& group, const std::string& module) :
      mean(group.reported("timing.modules." + module + ".cpu_mean_ms")),
      p95(group.reported("timing.modules." + module + ".cpu_p95_ms"))
  {
  }
  std::string text() const { return mean.text(kDecimals) + ", " + p95.text(kDecimals); }
  bool isShownAsZero() const
  {
    constexpr double kHalfOfTheLastDigit = 0.05;
    return p95.mean().value_or(0) < kHalfOfTheLastDigit &&
           mean.mean().value_or(0) < kHalfOfTheLastDigit;
  }

  static constexpr int kDecimals = 1;
};

/** The modules that work on every frame and take time in some run. */
std::set<std::string> modulesOf(const std::vector<Group>& groups)
{
  const std::string prefix = "timing.modules.", suffix = ".calls";
  std::set<std::string> modules;
  for (const auto& group : groups)
    for (const auto& [name, calls] : group.runs.front()->report)
    {
      if (name.rfind(prefix, 0) != 0 || name.size() <= prefix.size() + suffix.size() ||
          name.substr(name.size() - suffix.size()) != suffix || calls <= 1)
        continue;
      const auto module = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
      if (!ModuleTime(group, module).isShownAsZero()) modules.insert(module);
    }
  return modules;
}
}  // namespace

std::string trajectoryTable(const BenchmarkResults& results)
{
  const auto methods = results.methods();
  std::vector<std::string> heading{"ATE [m]", "poses", "keyframes", "odometry alone"};
  for (const auto& method : methods)
    if (method != "odometry") heading.push_back(method);
  MarkdownTable table(heading);
  std::vector<std::string> row;
  const auto finishRow = [&]
  {
    if (!row.empty()) table.add(row);
    row.clear();
  };
  std::string subjectAndPoses;
  for (const auto& group : groupsOf(results))
  {
    const BenchmarkJob& job = group.job();
    const bool truthIsInput = job.poses == "ground-truth";
    if (truthIsInput || !group.runs.front()->figure("trajectory.ate_rmse_m")) continue;
    if (const std::string key = job.line().substr(0, 2) + job.subject + " " + job.poses;
        key != subjectAndPoses)
    {
      finishRow();
      subjectAndPoses = key;
      row = {
          job.subject, posesText(job), group.text("trajectory.keyframes", 0),
          group.text("trajectory.ate_rmse_odometry_m", 3)};
      row.resize(heading.size(), "-");
    }
    for (std::size_t i = 4; i < heading.size(); ++i)
      if (heading[i] == job.method) row[i] = group.text("trajectory.ate_rmse_m", 3);
  }
  finishRow();
  return table.text();
}

std::string mappingTable(const BenchmarkResults& results)
{
  return figuresTable(
      mappingGroups(results), {
                                  {     "Trans [m]",     "objects.trans_m", 3},
                                  {     "Rot [deg]",     "objects.rot_deg", 2},
                                  {     "Shape IoU",   "objects.shape_iou", 3},
                                  {       "3-D IoU",      "objects.iou_3d", 3},
                                  {          "NEES", "objects.nees_center", 1},
                                  {"NEES of height", "objects.nees_height", 1},
                                  {   "NEES of yaw",    "objects.nees_yaw", 1}
  });
}

std::string instantiationTable(const BenchmarkResults& results)
{
  return figuresTable(
      mappingGroups(results), {
                                  {    "total",     "objects.truth", 1},
                                  {"estimated", "objects.estimated", 1},
                                  {  "correct",   "objects.matched", 1},
                                  {"precision", "objects.precision", 3},
                                  {   "recall",    "objects.recall", 3},
                                  {       "F1",        "objects.f1", 3}
  });
}

std::string timeTable(const BenchmarkResults& results)
{
  const auto groups = rgbdGroups(results, {"rawlog", "visual"});
  const auto modules = modulesOf(groups);
  std::vector<std::string> heading{"CPU [ms], mean and p95", "poses"};
  heading.insert(heading.end(), modules.begin(), modules.end());
  heading.insert(heading.end(), {"last optimisation", "whole run [s]", "peak memory [MB]"});
  MarkdownTable table(heading);
  for (const auto& group : groups)
  {
    std::vector<std::string> row{group.job().subject, posesText(group.job())};
    for (const auto& module : modules) row.push_back(ModuleTime(group, module).text());
    row.push_back(group.reported("timing.modules.consolidation.cpu_mean_ms").text(0));
    row.push_back(group.reported("timing.cpu_total_s").text(1));
    row.push_back(group.reported("timing.peak_memory_mb").text(0));
    table.add(row);
  }
  return table.text();
}

std::string sizeTable(const BenchmarkResults& results)
{
  constexpr double kKilobyte = 1000;
  MarkdownTable table(
      {"", "objects", "objects.quadmap [kB per object]", "objects.json [kB per object]"});
  for (const auto& group : rgbdGroups(results, {"rawlog"}))
  {
    MeanAndSpread count, map, json;
    for (const auto* run : group.runs)
    {
      const auto objects = run->report.find("objects");
      if (objects == run->report.end()) continue;
      count.add(objects->second);
      if (objects->second == 0) continue;
      map.add(run->fileSizes.at("objects.quadmap") / objects->second / kKilobyte);
      json.add(run->fileSizes.at("objects.json") / objects->second / kKilobyte);
    }
    table.add({group.job().subject, count.text(1), map.text(2), json.text(2)});
  }
  return table.text();
}

}  // namespace quadmap
