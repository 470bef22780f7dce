#include "quadmap/slam/ModuleTimes.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numeric>

namespace quadmap
{
double processCpuTime()
{
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double peakMemory_mb()
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    unsigned long kilobytes = 0;
    if (std::sscanf(line.c_str(), "VmHWM: %lu kB", &kilobytes) == 1)
      return static_cast<double>(kilobytes) / 1024.0;
  }
  return 0;
}

ModuleTimes::Scope::Scope(ModuleTimes& times, const std::string& module) :
    samples_ms_(times.samplesByModule_ms_[module]), start_ms_(1e3 * processCpuTime())
{
}

ModuleTimes::Scope::~Scope()
{
  samples_ms_.push_back(static_cast<float>(1e3 * processCpuTime() - start_ms_));
}

std::map<std::string, ModuleTimes::Summary> ModuleTimes::summaries() const
{
  std::map<std::string, Summary> result;
  for (const auto& [module, samples] : samplesByModule_ms_)
  {
    if (samples.empty()) continue;
    std::vector<float> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    const double total_ms = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    const std::size_t last = sorted.size() - 1;
    result[module] = {
        sorted.size(), total_ms / static_cast<double>(sorted.size()),
        static_cast<double>(sorted[std::min(last, sorted.size() * 95 / 100)]), 1e-3 * total_ms};
  }
  return result;
}

}  // namespace quadmap
