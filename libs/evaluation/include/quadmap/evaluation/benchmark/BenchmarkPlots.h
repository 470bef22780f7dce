#pragma once

#include <map>
#include <string>

#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/evaluation/benchmark/BenchmarkResults.h"

namespace quadmap
{
/** A plot with what it shows: "home, seed 1: error of the position". */
struct Picture
{
  std::string title, svg;
};

/** One trajectory in a plot of errors. */
struct NamedTrajectory
{
  std::string name;
  Trajectory estimated;
};

/** Distance of the positions to the true ones over time, each trajectory aligned by itself. */
Picture errorOverTimePlot(
    const std::string& title,
    const Trajectory& truth,
    const std::vector<NamedTrajectory>& trajectories);

/** The objects of a map and the true ones from above, in the frame of the map.
 * \param report With objects. */
Picture mapPlot(
    const std::string& title, const EvaluationReport& report, const Trajectory& estimated);

/** A bar per class and method: the mean of a figure ("trans_m") over all matches of simulated
 * scenes on drifting odometry. */
Picture classesPlot(
    const BenchmarkResults& results,
    const std::string& figure,
    const std::string& title,
    const std::string& unit);

/** All plots of a benchmark by file name: error-SUBJECT.svg and map-SUBJECT.svg of the lowest seed
 * of every scene and recording with a truth, classes-trans.svg, classes-shape.svg. */
std::map<std::string, Picture> benchmarkPlots(const BenchmarkResults& results);

}  // namespace quadmap
