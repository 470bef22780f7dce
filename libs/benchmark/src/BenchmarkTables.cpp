#include "quadmap/benchmark/BenchmarkTables.h"

#include <mrpt/core/format.h>

#include <set>

#include "MarkdownTable.h"

namespace quadmap
{
namespace
{
std::string joined(const std::set<std::string>& values)
{
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : "; ") + value;
  return text;
}

/** Text that says on what machine the figures were made, and which results are missing. */
std::string machineTable(const BenchmarkResults& results)
{
  std::map<std::string, std::set<std::string>> values;
  std::set<std::string> seeds, scenes, recordings;
  std::set<std::uint64_t> rooms;
  for (const auto& result : results.done)
  {
    for (const auto& [key, value] : result.machine) values[key].insert(value);
    if (result.job.subject == kRandomRooms)
    {
      rooms.insert(result.job.seed);
      continue;
    }
    const bool isRecorded = result.job.kind == BenchmarkKind::Recorded;
    (isRecorded ? recordings : scenes).insert(result.job.subject);
    if (!isRecorded) seeds.insert(std::to_string(result.job.seed));
  }
  MarkdownTable table({"", ""});
  for (const auto& [key, set] : values) table.add({key, joined(set)});
  table.add({"scenes", joined(scenes)});
  if (!rooms.empty()) table.add({"random rooms", std::to_string(rooms.size())});
  table.add({"recordings", joined(recordings)});
  table.add({"seeds", joined(seeds)});
  table.add(
      {"jobs", mrpt::format("%zu done, %zu missing", results.done.size(), results.missing.size())});
  std::string text = table.text();
  if (!results.missing.empty()) text += "\nMissing:\n\n";
  for (const auto& line : results.missing) text += "    " + line + "\n";
  return text;
}
}  // namespace

std::map<std::string, std::string> benchmarkTables(const BenchmarkResults& results)
{
  return {
      {      "machine",       machineTable(results)},
      {   "trajectory",    trajectoryTable(results)},
      {      "mapping",       mappingTable(results)},
      {"instantiation", instantiationTable(results)},
      {  "orientation",   orientationTable(results)},
      {     "ablation",      ablationTable(results)},
      {        "edges",         edgesTable(results)},
      {    "residuals",     residualsTable(results)},
      {         "time",          timeTable(results)},
      {         "size",          sizeTable(results)}
  };
}

}  // namespace quadmap
