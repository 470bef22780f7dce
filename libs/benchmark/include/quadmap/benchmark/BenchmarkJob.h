#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadmap
{
/** The scene that is another room for each random seed. Its spread is over rooms. */
constexpr const char* kRandomRooms = "random";

/** What a job of the benchmark looks at. */
enum class BenchmarkKind
{
  Simulated,  //!< A scene is simulated, mapped and compared with its truth
  Recorded,   //!< A real recording is imported, mapped and compared with its truth, if any
  Observed    //!< A scene's single frames are measured: a table of `observation_tables`
};

/** One job of the benchmark. A processor does it in one go, and it needs no other job. */
struct BenchmarkJob
{
  BenchmarkKind kind = BenchmarkKind::Simulated;
  std::string subject;     //!< Scene or recording
  std::uint64_t seed = 0;  //!< Random seed; 0 for a recording
  std::string method;      //!< --method of quadmap-slam; Observed: the table
  std::string poses;       //!< --odometry of quadmap-slam

  /** "simulated home 1 rgbd rawlog": a line of the job list. */
  std::string line() const;
  /** The same with dots, the name of the job's folder among the results. */
  std::string folder() const;
  /** \exception std::invalid_argument If it is not such a line. */
  static BenchmarkJob fromLine(const std::string& line);
};

/** The content of a benchmark. */
struct BenchmarkPlan
{
  std::vector<std::string> scenes;          //!< Mapped with every method
  std::vector<std::string> observedScenes;  //!< Their single frames are measured too
  std::vector<std::string> recordings;      //!< Names of folders; mapped with every method
  std::vector<std::uint64_t> seeds;         //!< Random seeds of the simulations
  std::vector<std::string> methods;         //!< --method of quadmap-slam
  unsigned rooms = 0;  //!< Random rooms, with the seeds 1 to this; mapped with the method rgbd
};

/** All jobs in the order in which they run: everything with the first random seed, then with the
 * next. Scenes are run with drifting and with true poses. Recordings are run with their own poses
 * (corrected, and as they are) and with visual odometry. The method "odometry" is not run on given
 * poses, which it would not change. Random rooms come last, with the method rgbd alone, if it is
 * one of the methods. \exception std::invalid_argument For names with blanks, dots or slashes,
 * which would break lines and folders. */
std::vector<BenchmarkJob> jobsOf(const BenchmarkPlan& plan);

}  // namespace quadmap
