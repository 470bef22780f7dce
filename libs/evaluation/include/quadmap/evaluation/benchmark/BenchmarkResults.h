#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadmap/evaluation/benchmark/BenchmarkJob.h"

namespace quadmap
{
/** The numbers of a JSON file by their path, "timing.modules.map.cpu_p95_ms"; null: not there. */
using Figures = std::map<std::string, double>;

/** What one job has left in its folder. */
struct BenchmarkResult
{
  BenchmarkJob job;
  std::string folder;  //!< Its path

  /** A true object that was found; the figures have the names of evaluation.json. */
  struct Match
  {
    std::string label;
    Figures figures;
  };

  Figures evaluation;  //!< evaluation.json of a run
  std::vector<Match> matches;
  Figures report;  //!< report.json of a run, without the associations
  /** File sizes of a run [bytes] by name. */
  std::map<std::string, double> fileSizes;
  /** observation.json of an observation: rows in their order with their numbers. */
  std::vector<std::pair<std::string, Figures>> rows;

  std::map<std::string, std::string> machine;  //!< machine.json: where and with what it ran

  std::optional<double> figure(const std::string& name) const;  //!< Of the evaluation
};

struct BenchmarkResults
{
  std::vector<BenchmarkResult> done;  //!< Sorted by the names of their folders
  std::vector<std::string> missing;   //!< Lines of jobs.txt without a result

  /** The method of each run, in the order in which tables show them. */
  std::vector<std::string> methods() const;
};

/** Reads RESULTS/jobs.txt and RESULTS/runs/: all results that are there, in the list or not.
 * \exception std::runtime_error For a folder without results, for results of different commits, and
 * for broken files, by name. */
BenchmarkResults readBenchmarkResults(const std::string& folder);

}  // namespace quadmap
