#pragma once

#include <map>
#include <string>

#include "quadmap/benchmark/BenchmarkResults.h"

namespace quadmap
{
/** All tables as Markdown, by the name of their section: machine, trajectory, mapping,
 * instantiation, orientation, ablation, edges, residuals, time, size. Each figure is the mean over
 * the random seeds, with its standard deviation. The tables orientation and residuals take all
 * random seeds as one sample. */
std::map<std::string, std::string> benchmarkTables(const BenchmarkResults& results);

}  // namespace quadmap
