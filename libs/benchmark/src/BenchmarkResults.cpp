#include "quadmap/benchmark/BenchmarkResults.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "quadmap/base/InputFile.h"
#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

const char* const kMachineFormat = "quadmap-machine";

void addNumbers(const Json& json, const std::string& prefix, Figures& out)
{
  for (const auto& [key, value] : json.items())
  {
    const std::string name = prefix.empty() ? key : prefix + "." + key;
    if (value.is_number()) out[name] = value.get<double>();
    if (value.is_object()) addNumbers(value, name, out);
  }
}

Figures numbersOf(const Json& json)
{
  Figures out;
  addNumbers(json, "", out);
  return out;
}

std::string firstLine(const fs::path& path)
{
  auto file = openModestText(path.string());
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path.string() + ": cannot be read");
  return line;
}

/** Checks that all results are of one commit. \exception std::runtime_error If they are not. */
void requireOneCommit(const std::string& folder, const std::vector<BenchmarkResult>& results)
{
  std::set<std::string> commits;
  for (const auto& result : results)
    if (const auto found = result.machine.find("commit"); found != result.machine.end())
      commits.insert(found->second);
  if (commits.size() < 2) return;
  std::string list;
  for (const auto& commit : commits) list += (list.empty() ? "" : ", ") + commit;
  throw std::runtime_error(
      folder + ": results of different commits (" + list + "); each needs a folder of its own");
}

/** On what machine and of which commit a result was made: texts by their names.
 * \exception std::runtime_error If the file does not say so. */
std::map<std::string, std::string> machineOf(const std::string& path)
{
  const Json json = readJson(path);
  if (!json.is_object() || json.value("format", Json(kMachineFormat)) != kMachineFormat ||
      json.value("version", Json(1)) != 1)
    throw std::runtime_error(path + ": is no " + kMachineFormat + " of version 1");
  if (!json.value("processor", Json()).is_string())
    throw std::runtime_error(path + ": has no text \"processor\"");
  std::map<std::string, std::string> machine;
  for (const auto& [key, value] : json.items())
    if (key != "format" && key != "version")
      machine[key] = value.is_string() ? value.get<std::string>() : jsonText(value);
  return machine;
}

void readRun(const fs::path& folder, BenchmarkResult& result)
{
  const std::string path = (folder / "evaluation.json").string();
  const Json evaluation = readJson(path);
  result.evaluation = numbersOf(evaluation);
  try
  {
    for (const auto& match : evaluation.at("matches"))
      result.matches.push_back({match.at("label").get<std::string>(), numbersOf(match)});
  }
  catch (const Json::exception&)  // its text is about the inside of the library
  {
    throw std::runtime_error(path + ": its \"matches\" are not those of quadmap-evaluate");
  }
  result.report = numbersOf(readJson((folder / "report.json").string()));
  for (const auto& entry : fs::directory_iterator(folder))
    result.fileSizes[entry.path().filename().string()] = static_cast<double>(entry.file_size());
}

BenchmarkResult readResult(const fs::path& folder)
{
  BenchmarkResult result;
  result.folder = folder.string();
  result.job = BenchmarkJob::fromLine(firstLine(folder / "job.txt"));
  result.machine = machineOf((folder / "machine.json").string());
  if (result.job.kind == BenchmarkKind::Observed)
  {
    const std::string path = (folder / "observation.json").string();
    const Json observation = readJson(path);
    if (!observation.is_object() || !observation.contains("rows"))
      throw std::runtime_error(path + ": has no \"rows\"");
    for (const auto& [name, row] : observation.at("rows").items())
      result.rows.emplace_back(name, numbersOf(row));
  }
  else
    readRun(folder, result);
  return result;
}
}  // namespace

std::optional<double> BenchmarkResult::figure(const std::string& name) const
{
  const auto found = evaluation.find(name);
  if (found == evaluation.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> BenchmarkResults::methods() const
{
  std::set<std::string> present;
  for (const auto& result : done)
    if (result.job.kind != BenchmarkKind::Observed) present.insert(result.job.method);
  std::vector<std::string> ordered;
  for (const char* name : {"odometry", "rgbd", "quadric", "point"})
    if (present.erase(name)) ordered.emplace_back(name);
  ordered.insert(ordered.end(), present.begin(), present.end());
  return ordered;
}

BenchmarkResults readBenchmarkResults(const std::string& folder)
{
  const fs::path runs = fs::path(folder) / "runs";
  std::set<fs::path> folders;  // sorted
  if (fs::is_directory(runs))
    for (const auto& entry : fs::directory_iterator(runs))
      if (entry.is_directory() && entry.path().filename().string()[0] != '.')
        folders.insert(entry.path());
  if (folders.empty()) throw std::runtime_error(runs.string() + ": no results");

  BenchmarkResults results;
  std::set<std::string> lines;
  for (const auto& path : folders)
  {
    results.done.push_back(readResult(path));
    lines.insert(results.done.back().job.line());
  }
  requireOneCommit(folder, results.done);
  const fs::path jobs = fs::path(folder) / "jobs.txt";
  if (!fs::exists(jobs)) return results;
  auto list = openModestText(jobs.string());
  for (std::string line; std::getline(list, line);)
    if (!line.empty() && lines.count(line) == 0) results.missing.push_back(line);
  return results;
}

}  // namespace quadmap
