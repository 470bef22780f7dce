#include "quadmap/benchmark/BenchmarkPlots.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>

#include "MeanAndSpread.h"
#include "quadmap/base/SvgPlot.h"
#include "quadmap/geometry/ConvexHull.h"

namespace quadmap
{
namespace
{
using Points = std::vector<Eigen::Vector2d>;

constexpr const char* kColors[] = {"#7f7f7f", "#1f77b4", "#ff7f0e", "#2ca02c", "#9467bd"};
constexpr const char *kTrueColor = "#444444", *kFoundColor = "#1f77b4", *kFalseColor = "#d62728",
                     *kMissedColor = "#ff7f0e";
constexpr std::size_t kMaxPoints = 300;  // of a line, as more cannot be told apart

const char* colorOf(std::size_t i) { return kColors[i % std::size(kColors)]; }

Points thinned(const Points& points)
{
  const std::size_t step = points.size() / kMaxPoints + 1;
  Points out;
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back(points[i]);
  return out;
}

/** Outline of a cuboid from above. */
Points footprint(const Ellipsoid& object)
{
  const Eigen::Matrix<double, 3, 8> corners = object.cuboidCorners();
  Points flat;
  for (int i = 0; i < 8; ++i) flat.emplace_back(corners.col(i).head<2>());
  return convexHull(std::move(flat));
}

std::string titleOf(const BenchmarkJob& job)
{
  if (job.kind == BenchmarkKind::Recorded) return job.subject;
  return mrpt::format("%s, seed %llu", job.subject.c_str(), (unsigned long long)job.seed);
}

std::string inFolder(const BenchmarkResult& run, const char* file)
{
  return (std::filesystem::path(run.folder) / file).string();
}

/** The runs that the plots show, by scene or recording: those of the lowest random seed. Recordings
 * are shown with visual odometry, because their own poses are the truth. */
std::map<std::string, std::vector<const BenchmarkResult*>> shownRuns(
    const BenchmarkResults& results)
{
  std::map<std::string, std::vector<const BenchmarkResult*>> shown;
  for (const auto& run : results.done)
  {
    const bool isRecorded = run.job.kind == BenchmarkKind::Recorded;
    if (run.job.kind == BenchmarkKind::Observed ||
        run.job.poses != (isRecorded ? "visual" : "rawlog"))
      continue;
    auto& runs = shown[run.job.subject];
    if (!runs.empty() && run.job.seed < runs.front()->job.seed) runs.clear();
    if (runs.empty() || run.job.seed == runs.front()->job.seed) runs.push_back(&run);
  }
  return shown;
}

Picture errorPlotOf(
    const std::vector<const BenchmarkResult*>& runs, const std::vector<std::string>& methods)
{
  std::vector<NamedTrajectory> trajectories;
  trajectories.push_back(
      {"odometry", readTumTrajectory(inFolder(*runs.front(), "trajectory_odometry.tum"))});
  for (const auto& method : methods)
    for (const auto* run : runs)
      if (run->job.method == method && method != "odometry")
        trajectories.push_back({method, readTumTrajectory(inFolder(*run, "trajectory.tum"))});
  return errorOverTimePlot(
      titleOf(runs.front()->job), readTumTrajectory(inFolder(*runs.front(), "groundtruth.tum")),
      trajectories);
}

Picture mapPlotOf(const BenchmarkResult& run)
{
  EvaluationInput input;
  input.estimate = run.folder;
  input.trueObjectsPath = inFolder(run, "objects.gt.json");
  input.trueTrajectoryPath = inFolder(run, "groundtruth.tum");
  return mapPlot(
      titleOf(run.job) + ", " + run.job.method, evaluateRun(input),
      readTumTrajectory(inFolder(run, "trajectory.tum")));
}

/** Values of a figure by label, for one method. Random rooms are not among them, as they are mapped
 * with one method alone. */
std::map<std::string, MeanAndSpread> byClass(
    const BenchmarkResults& results, const std::string& method, const std::string& figure)
{
  std::map<std::string, MeanAndSpread> values;
  for (const auto& run : results.done)
    if (run.job.kind == BenchmarkKind::Simulated && run.job.subject != kRandomRooms &&
        run.job.poses == "rawlog" && run.job.method == method)
      for (const auto& match : run.matches)
        if (const auto found = match.figures.find(figure); found != match.figures.end())
          values[match.label].add(found->second);
  return values;
}
}  // namespace

Picture errorOverTimePlot(
    const std::string& title,
    const Trajectory& truth,
    const std::vector<NamedTrajectory>& trajectories)
{
  const std::string shown = title + ": error of the position";
  SvgPlot plot({shown, "time [s]", "distance to the true position [m]"});
  for (std::size_t i = 0; i < trajectories.size(); ++i)
  {
    const auto pairs = pairByTime(truth, trajectories[i].estimated, kMaxTimeDifference);
    if (pairs.empty()) continue;
    const mrpt::poses::CPose3D T = alignPositions(pairs);
    Points points;
    for (const auto& pair : pairs)
      points.emplace_back(
          pair.time - pairs.front().time,
          (T + pair.T_estimated_body).distanceTo(pair.T_truth_body));
    plot.addLine(thinned(points), {colorOf(i), 1.5, false, 0}, trajectories[i].name);
  }
  return {shown, plot.toSvg()};
}

Picture mapPlot(
    const std::string& title, const EvaluationReport& report, const Trajectory& estimated)
{
  const std::string shown = title + ": the map from above";
  SvgPlot plot({shown, "x [m]", "y [m]"}, true);
  const mrpt::poses::CPose3D T_map_truth = -report.T_truth_estimated;
  const auto draw =
      [&](const ObjectRecord& record, const SvgPlot::Style& style, const std::string& legend)
  { plot.addArea(footprint(record.object.transformed(T_map_truth)), style, legend); };

  Points way;
  for (const auto& pose : estimated) way.emplace_back(pose.pose.x(), pose.pose.y());
  plot.addLine(thinned(way), {"#bbbbbb", 1, false, 0}, "robot");
  for (const auto& match : report.objects->matches)
  {
    draw(match.estimated, {kFoundColor, 1.5, false, 0.2}, "found");
    draw(match.truth, {kTrueColor, 1, true, 0}, "truth");
  }
  for (const auto& missed : report.objects->missed)
    draw(missed, {kMissedColor, 1.5, true, 0}, "missed");
  for (const auto& spurious : report.objects->spurious)
    draw(spurious, {kFalseColor, 1.5, false, 0.2}, "false");
  for (const auto& match : report.objects->matches)
    plot.addText(
        match.estimated.object.transformed(T_map_truth).center().head<2>(), match.truth.label);
  return {shown, plot.toSvg()};
}

Picture classesPlot(
    const BenchmarkResults& results,
    const std::string& figure,
    const std::string& title,
    const std::string& unit)
{
  std::vector<std::string> methods = results.methods();
  methods.erase(std::remove(methods.begin(), methods.end(), "odometry"), methods.end());
  std::map<std::string, std::map<std::string, MeanAndSpread>> ofMethod;
  std::vector<std::string> classes;
  for (const auto& method : methods)
    for (const auto& [label, values] : ofMethod[method] = byClass(results, method, figure))
      classes.push_back(label);
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());

  SvgPlot plot({title, "", unit});
  plot.setNamesOfX(classes);
  constexpr double kGroup = 0.8;  // width of the bars of a label
  const double width = kGroup / static_cast<double>(std::max<std::size_t>(1, methods.size()));
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (const auto mean = ofMethod[methods[m]][classes[c]].mean())
        plot.addBar(
            static_cast<double>(c) - kGroup / 2 + (static_cast<double>(m) + 0.5) * width,
            0.9 * width, *mean, {colorOf(m + 1), 1, false, 0.7}, methods[m]);
  return {title, plot.toSvg()};
}

std::map<std::string, Picture> benchmarkPlots(const BenchmarkResults& results)
{
  std::map<std::string, Picture> plots;
  for (const auto& [subject, runs] : shownRuns(results))
  {
    if (runs.front()->fileSizes.count("groundtruth.tum") == 0) continue;
    plots["error-" + subject + ".svg"] = errorPlotOf(runs, results.methods());
    for (const auto* run : runs)
      if (run->job.method == "rgbd" && run->fileSizes.count("objects.gt.json"))
        plots["map-" + subject + ".svg"] = mapPlotOf(*run);
  }
  plots["classes-trans.svg"] = classesPlot(
      results, "trans_m", "Error of the position by class, drifting odometry", "Trans [m]");
  plots["classes-shape.svg"] =
      classesPlot(results, "shape_iou", "Shape by class, drifting odometry", "Shape IoU");
  return plots;
}

}  // namespace quadmap
