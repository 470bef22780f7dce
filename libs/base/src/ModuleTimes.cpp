#include "quadmap/base/ModuleTimes.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numeric>

namespace quadmap
{
namespace
{
double cpuTime(clockid_t clock)
{
  timespec t{};
  ::clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double threadCpuTime() { return cpuTime(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace

double processCpuTime() { return cpuTime(CLOCK_PROCESS_CPUTIME_ID); }

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
    times_(times), module_(module), start_(threadCpuTime())
{
}

ModuleTimes::Scope::~Scope()
{
  const double spent_ms = 1e3 * (threadCpuTime() - start_);
  const std::lock_guard lock(times_.mutex_);
  times_.samplesByModule_ms_[module_].push_back(static_cast<float>(spent_ms));
}

std::map<std::string, ModuleTimes::Summary> ModuleTimes::summaries() const
{
  const std::lock_guard lock(mutex_);
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
