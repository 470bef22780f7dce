#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "quadmap/benchmark/BenchmarkResults.h"

namespace quadmap
{
/** A table in the Markdown of GitHub. */
class MarkdownTable
{
 public:
  explicit MarkdownTable(const std::vector<std::string>& heading) : columns_(heading.size())
  {
    add(heading);
    text_ += "|";
    for (std::size_t i = 0; i < columns_; ++i) text_ += "---|";
    text_ += "\n";
  }

  /** Adds a row. Cells that are not given stay empty. */
  void add(std::vector<std::string> row)
  {
    row.resize(columns_);
    text_ += "|";
    for (const auto& cell : row) text_ += " " + cell + " |";
    text_ += "\n";
  }

  const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  std::string text_;
};

/** The different values of a member of the jobs that satisfy a condition, sorted. */
template <typename Member, typename Condition>
std::vector<std::string> valuesOf(
    const BenchmarkResults& results, const Member& member, const Condition& condition)
{
  std::vector<std::string> out;
  for (const auto& result : results.done)
    if (condition(result.job)) out.push_back(result.job.*member);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::string trajectoryTable(const BenchmarkResults& results);
std::string mappingTable(const BenchmarkResults& results);
std::string instantiationTable(const BenchmarkResults& results);
std::string timeTable(const BenchmarkResults& results);
std::string sizeTable(const BenchmarkResults& results);
std::string orientationTable(const BenchmarkResults& results);
std::string ablationTable(const BenchmarkResults& results);
std::string edgesTable(const BenchmarkResults& results);
std::string residualsTable(const BenchmarkResults& results);

}  // namespace quadmap
