#include <mrpt/core/format.h>

#include <cmath>

#include "MarkdownTable.h"
#include "MeanAndSpread.h"

namespace quadmap
{
namespace
{
using Rows = std::vector<std::pair<std::string, Figures>>;

/** Share of its variance that a normal distribution keeps when it is cut at 3 sigma. */
constexpr double kVarianceWithin3Sigma = 0.9733;

std::vector<const BenchmarkResult*> observations(
    const BenchmarkResults& results, const std::string& table, const std::string& scene)
{
  std::vector<const BenchmarkResult*> out;
  for (const auto& result : results.done)
    if (result.job.kind == BenchmarkKind::Observed && result.job.method == table &&
        result.job.subject == scene)
      out.push_back(&result);
  return out;
}

std::vector<std::string> scenesOf(const BenchmarkResults& results, const std::string& table)
{
  return valuesOf(
      results, &BenchmarkJob::subject,
      [&](const BenchmarkJob& job)
      { return job.kind == BenchmarkKind::Observed && job.method == table; });
}

Figures* rowOf(Rows& rows, const std::string& name)
{
  for (auto& row : rows)
    if (row.first == name) return &row.second;
  return nullptr;
}

/** Counts and sums over all random seeds. */
Rows summed(const std::vector<const BenchmarkResult*>& results)
{
  Rows rows;
  for (const auto* result : results)
    for (const auto& [name, figures] : result->rows)
    {
      if (!rowOf(rows, name)) rows.push_back({name, {}});
      for (const auto& [column, value] : figures) (*rowOf(rows, name))[column] += value;
    }
  return rows;
}

/** The figures of one row, for each random seed. */
std::vector<const Figures*> ofEachSeed(
    const std::vector<const BenchmarkResult*>& results, const std::string& row)
{
  std::vector<const Figures*> out;
  for (const auto* result : results)
    for (const auto& [name, figures] : result->rows)
      if (name == row) out.push_back(&figures);
  return out;
}

double numberOf(const Figures& figures, const std::string& name)
{
  const auto found = figures.find(name);
  return found == figures.end() ? 0 : found->second;
}

std::string seedsOf(const std::vector<const BenchmarkResult*>& results)
{
  return mrpt::format("%zu %s", results.size(), results.size() == 1 ? "seed" : "seeds");
}

/** "bias, variance, beyond 3 sigma" of one type of residual. */
std::string residualText(const Figures& sums)
{
  const double count = numberOf(sums, "count"), inside = numberOf(sums, "inside");
  if (count == 0) return "-";
  const std::string beyond =
      mrpt::format("%.0f %% (%.0f)", 100 * numberOf(sums, "beyond") / count, count);
  if (inside == 0) return "violated " + beyond;
  const double mean = numberOf(sums, "sum") / inside;
  const double variance = numberOf(sums, "squares") / inside - mean * mean;
  return mrpt::format("%.2f, %.2f, ", mean, variance / kVarianceWithin3Sigma) + beyond;
}

/** "precision of the usable" and "recall of the good" edges of one row. */
std::pair<std::string, std::string> edgeQuality(const std::vector<const Figures*>& seeds)
{
  MeanAndSpread precision, recall;
  for (const auto* figures : seeds)
  {
    const double usableGood = numberOf(*figures, "usable_good");
    const double usable = usableGood + numberOf(*figures, "usable_invalid");
    const double good = numberOf(*figures, "good");
    if (usable > 0) precision.add(usableGood / usable);
    if (good > 0) recall.add(usableGood / good);
  }
  return {precision.text(3), recall.text(3)};
}
/** Mean error in rotation of the mapped objects of one label, over the scenes whose single frames
 * were measured too. */
std::string mappedRotation(
    const BenchmarkResults& results,
    const std::vector<std::string>& scenes,
    const std::string& label,
    const std::string& poses)
{
  MeanAndSpread angles;
  for (const auto& run : results.done)
  {
    const BenchmarkJob& job = run.job;
    if (job.kind != BenchmarkKind::Simulated || job.method != "rgbd" || job.poses != poses ||
        std::find(scenes.begin(), scenes.end(), job.subject) == scenes.end())
      continue;
    for (const auto& match : run.matches)
      if (match.label == label && match.figures.count("rot_deg"))
        angles.add(match.figures.at("rot_deg"));
  }
  return angles.count() == 0 ? "-" : mrpt::format("%.2f (%zu)", *angles.mean(), angles.count());
}
}  // namespace

std::string orientationTable(const BenchmarkResults& results)
{
  const auto scenes = scenesOf(results, "orientation");
  std::vector<const BenchmarkResult*> all;
  for (const auto& scene : scenes)
    for (const auto* result : observations(results, "orientation", scene)) all.push_back(result);
  MarkdownTable table(
      {"Rot [deg] (how many)", "single frames", "map, poses given", "map, drifting odometry"});
  auto rows = summed(all);
  std::sort(
      rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [label, sums] : rows)
  {
    const double count = numberOf(sums, "count");
    table.add(
        {label, mrpt::format("%.2f (%.0f)", numberOf(sums, "sum_deg") / count, count),
         mappedRotation(results, scenes, label, "ground-truth"),
         mappedRotation(results, scenes, label, "rawlog")});
  }
  return table.text();
}

std::string ablationTable(const BenchmarkResults& results)
{
  const std::vector<std::pair<std::string, int>> columns = {
      {  "trans_m", 3},
      {  "rot_deg", 2},
      {"shape_iou", 3},
      {   "iou_3d", 3},
      {"precision", 2},
      {   "recall", 2},
      {       "f1", 3}
  };
  std::string text;
  for (const auto& scene : scenesOf(results, "ablation"))
  {
    const auto found = observations(results, "ablation", scene);
    MarkdownTable table(
        {scene + ", " + seedsOf(found), "Trans [m]", "Rot [deg]", "Shape IoU", "3-D IoU",
         "precision", "recall", "F1"});
    for (const auto& [setting, ignored] : found.front()->rows)
    {
      std::vector<std::string> row{setting};
      for (const auto& [column, decimals] : columns)
      {
        MeanAndSpread values;
        for (const auto* figures : ofEachSeed(found, setting))
          if (figures->count(column)) values.add(figures->at(column));
        row.push_back(values.text(decimals));
      }
      table.add(row);
    }
    text += (text.empty() ? "" : "\n") + table.text();
  }
  return text;
}

std::string edgesTable(const BenchmarkResults& results)
{
  MarkdownTable table(
      {"", "edges", "rule", "good", "invalid", "precision of the usable", "recall of the good"});
  for (const auto& scene : scenesOf(results, "edges"))
  {
    const auto found = observations(results, "edges", scene);
    for (const auto& [name, sums] : summed(found))
    {
      const auto slash = name.find(" / ");
      const auto [precision, recall] = edgeQuality(ofEachSeed(found, name));
      table.add(
          {scene, name.substr(0, slash), name.substr(slash + 3),
           mrpt::format("%.0f", numberOf(sums, "good")),
           mrpt::format("%.0f", numberOf(sums, "invalid")), precision, recall});
    }
  }
  return table.text();
}

std::string residualsTable(const BenchmarkResults& results)
{
  const auto scenes = scenesOf(results, "residuals");
  std::vector<std::string> heading{"bias, variance, beyond 3 sigma (how many)"};
  std::vector<Rows> ofScene;
  Rows all;
  for (const auto& scene : scenes)
  {
    const auto found = observations(results, "residuals", scene);
    heading.push_back(scene + ", " + seedsOf(found));
    ofScene.push_back(summed(found));
    for (const auto& row : ofScene.back())
      if (!rowOf(all, row.first)) all.push_back({row.first, {}});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  MarkdownTable table(heading);
  for (const auto& [factor, ignored] : all)
  {
    std::vector<std::string> row{factor};
    for (auto& rows : ofScene)
    {
      const Figures* sums = rowOf(rows, factor);
      row.push_back(sums ? residualText(*sums) : "-");
    }
    table.add(row);
  }
  return table.text();
}

}  // namespace quadmap
