#include "quadmap/benchmark/BenchmarkJob.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace quadmap
{
namespace
{
constexpr std::pair<BenchmarkKind, const char*> kKinds[] = {
    {BenchmarkKind::Simulated, "simulated"},
    { BenchmarkKind::Recorded,  "recorded"},
    { BenchmarkKind::Observed,  "observed"}
};

constexpr const char* kObservationTables[] = {"residuals", "edges", "ablation", "orientation"};

void requireWord(const std::string& name)
{
  if (name.empty() || name.find_first_of(" \t\n./") != std::string::npos)
    throw std::invalid_argument(
        "\"" + name + "\": the name of a job must be a word without dots and slashes");
}

/** Adds the jobs of one scene or recording, for all sources of poses and all methods. */
void addRuns(
    BenchmarkJob job,
    const std::vector<std::string>& methods,
    const std::vector<std::string>& poses,
    std::vector<BenchmarkJob>& out)
{
  for (const auto& method : methods)
    for (const auto& source : poses)
    {
      if (method == "odometry" && source == "ground-truth") continue;
      job.method = method;
      job.poses = source;
      out.push_back(job);
    }
}
}  // namespace

std::string BenchmarkJob::line() const
{
  for (const auto& [value, name] : kKinds)
    if (value == kind)
      return std::string(name) + " " + subject + " " + std::to_string(seed) + " " + method + " " +
             poses;
  throw std::logic_error("kind of a job without a name");
}

std::string BenchmarkJob::folder() const
{
  std::string name = line();
  std::replace(name.begin(), name.end(), ' ', '.');
  return name;
}

BenchmarkJob BenchmarkJob::fromLine(const std::string& line)
{
  std::istringstream words(line);
  std::string kind, rest;
  BenchmarkJob job;
  words >> kind >> job.subject >> job.seed >> job.method >> job.poses;
  const auto* known = std::find_if(
      std::begin(kKinds), std::end(kKinds), [&](const auto& k) { return kind == k.second; });
  if (!words || words >> rest || known == std::end(kKinds))
    throw std::invalid_argument(
        "\"" + line + "\": expected simulated|recorded|observed SUBJECT SEED METHOD POSES");
  job.kind = known->first;
  return job;
}

std::vector<BenchmarkJob> jobsOf(const BenchmarkPlan& plan)
{
  for (const auto* names : {&plan.scenes, &plan.observedScenes, &plan.recordings, &plan.methods})
    for (const auto& name : *names) requireWord(name);

  std::vector<BenchmarkJob> jobs;
  for (const auto& recording : plan.recordings)
    addRuns(
        {BenchmarkKind::Recorded, recording, 0, "", ""}, plan.methods,
        {"rawlog", "visual", "ground-truth"}, jobs);
  for (const auto seed : plan.seeds)
  {
    for (const auto& method : plan.methods)
      for (const auto& scene : plan.scenes)
        addRuns(
            {BenchmarkKind::Simulated, scene, seed, "", ""}, {method}, {"rawlog", "ground-truth"},
            jobs);
    for (const auto& scene : plan.observedScenes)
      for (const auto* table : kObservationTables)
        jobs.push_back({BenchmarkKind::Observed, scene, seed, table, "ground-truth"});
  }
  const bool mapsRooms =
      std::find(plan.methods.begin(), plan.methods.end(), "rgbd") != plan.methods.end();
  for (std::uint64_t seed = 1; mapsRooms && seed <= plan.rooms; ++seed)
    addRuns(
        {BenchmarkKind::Simulated, kRandomRooms, seed, "", ""}, {"rgbd"},
        {"rawlog", "ground-truth"}, jobs);
  return jobs;
}

}  // namespace quadmap
