#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadmap/benchmark/BenchmarkJob.h"

namespace quadmap
{
/** The numbers of a JSON file by their path, "timing.modules.map.cpu_p95_ms". A null is left out.
 */
using Figures = std::map<std::string, double>;

/** The content of the folder of one job. */
struct BenchmarkResult
{
  BenchmarkJob job;
  std::string folder;  //!< Path of the folder

  /** A true object that was found. Its figures have the names of evaluation.json. */
  struct Match
  {
    std::string label;
    Figures figures;
  };

  Figures evaluation;  //!< Figures of evaluation.json of a run
  std::vector<Match> matches;
  Figures report;  //!< Figures of report.json of a run
  /** File sizes of a run [bytes] by name. */
  std::map<std::string, double> fileSizes;
  /** Names and numbers of the rows of observation.json, in their order. */
  std::vector<std::pair<std::string, Figures>> rows;

  std::map<std::string, std::string> machine;  //!< machine.json: on what it ran

  std::optional<double> figure(const std::string& name) const;  //!< A figure of `evaluation`
};

struct BenchmarkResults
{
  std::vector<BenchmarkResult> done;  //!< Sorted by the names of the folders
  std::vector<std::string> missing;   //!< Lines of jobs.txt without a result

  /** The methods of all runs, in the order in which tables show them. */
  std::vector<std::string> methods() const;
};

/** Reads RESULTS/jobs.txt and all results in RESULTS/runs/, whether they are in the list or not.
 * \exception std::runtime_error For a folder without results, for results of different commits, and
 * for broken files. The message names the file. */
BenchmarkResults readBenchmarkResults(const std::string& folder);

}  // namespace quadmap
