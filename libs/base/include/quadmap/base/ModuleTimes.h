#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace quadmap
{
/** CPU time of the parts of a program. Each part counts the thread that it runs in. Parts may run
 * at the same time. */
class ModuleTimes
{
 public:
  /** Measures the time of its life. */
  class Scope
  {
   public:
    Scope(ModuleTimes& times, const std::string& module);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    ModuleTimes& times_;
    const std::string module_;
    const double start_;  //!< [s]
  };
  Scope measure(const std::string& module) { return Scope(*this, module); }

  struct Summary
  {
    std::size_t calls = 0;
    double mean_ms = 0, p95_ms = 0, total_s = 0;
  };
  std::map<std::string, Summary> summaries() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<float>> samplesByModule_ms_;
};

double processCpuTime();  //!< CPU time of this process so far [s]
double peakMemory_mb();   //!< Largest resident memory so far, 0 if unknown [MB]

}  // namespace quadmap
