#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadmap
{
/** What a job of the benchmark looks at. */
enum class BenchmarkKind
{
  Simulated,  //!< A scene is simulated, mapped and compared with its truth
  Recorded,   //!< A real recording is imported, mapped and compared with what truth it has
  Observed    //!< A scene's single frames are measured: a table of `observation_tables`
};

/** One job of the benchmark: what a processor does in one go, without any other job. */
struct BenchmarkJob
{
  BenchmarkKind kind = BenchmarkKind::Simulated;
  std::string subject;     //!< Scene or recording
  std::uint64_t seed = 0;  //!< 0 of a recording
  std::string method;      //!< --method of quadmap-slam; Observed: the table
  std::string poses;       //!< --odometry of quadmap-slam

  /** "simulated home 1 rgbd rawlog": a line of the job list. */
  std::string line() const;
  /** The same with dots: its folder among the results. */
  std::string folder() const;
  /** \exception std::invalid_argument If it is not such a line. */
  static BenchmarkJob fromLine(const std::string& line);
};

/** What a benchmark consists of. */
struct BenchmarkPlan
{
  std::vector<std::string> scenes;          //!< Mapped with every method
  std::vector<std::string> observedScenes;  //!< Single frames are looked at too
  std::vector<std::string> recordings;      //!< Names of folders; mapped with every method
  std::vector<std::uint64_t> seeds;         //!< Of the simulations
  std::vector<std::string> methods;         //!< --method of quadmap-slam
};

/** All jobs in the order in which they run: the first seed of everything, then the next. Scenes get
 * drifting and true poses, recordings the recorded poses (corrected and as they are) and visual
 * odometry. The method "odometry" has nothing to do with poses that are given.
 * \exception std::invalid_argument For names with blanks, dots or slashes, which would break lines
 * and folders. */
std::vector<BenchmarkJob> jobsOf(const BenchmarkPlan& plan);

}  // namespace quadmap
