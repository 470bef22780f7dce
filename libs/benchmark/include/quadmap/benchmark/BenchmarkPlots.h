#pragma once

#include <map>
#include <string>

#include "quadmap/benchmark/BenchmarkResults.h"
#include "quadmap/evaluation/EvaluationReport.h"

namespace quadmap
{
/** A plot and its title, "home, seed 1: error of the position". */
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

/** Plots the distance from true positions over time. Each trajectory is aligned by itself. */
Picture errorOverTimePlot(
    const std::string& title,
    const Trajectory& truth,
    const std::vector<NamedTrajectory>& trajectories);

/** Draws the objects of a map and the true ones from above, in the frame of the map.
 * \param report It must have objects. */
Picture mapPlot(
    const std::string& title, const EvaluationReport& report, const Trajectory& estimated);

/** Draws a bar per label and method: the mean of a figure ("trans_m") over all matches in simulated
 * scenes with drifting odometry. */
Picture classesPlot(
    const BenchmarkResults& results,
    const std::string& figure,
    const std::string& title,
    const std::string& unit);

/** All plots of a benchmark by file name. error-SUBJECT.svg and map-SUBJECT.svg are of the lowest
 * random seed of every scene and recording with a truth. classes-trans.svg and classes-shape.svg
 * are over all of them. */
std::map<std::string, Picture> benchmarkPlots(const BenchmarkResults& results);

}  // namespace quadmap
