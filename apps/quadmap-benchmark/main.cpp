#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "common/Subcommands.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/Json.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/benchmark/BenchmarkPlots.h"
#include "quadmap/benchmark/BenchmarkTables.h"
#include "quadmap/benchmark/GeneratedSections.h"
#include "quadmap/slam/SlamOptions.h"

// The parts of the benchmark that no existing program does; share/quadmap/benchmark/run calls them.

namespace
{
using namespace quadmap;
namespace fs = std::filesystem;

/** The items of a list; none of an empty one. */
std::vector<std::string> itemsOf(const std::string& option, const std::string& list)
{
  std::vector<std::string> items;
  std::istringstream text(list + (list.empty() ? "" : ","));
  for (std::string item; std::getline(text, item, ',');)
  {
    if (item.empty()) throw cli::UsageError(option + ": \"" + list + "\" has an empty item");
    if (std::find(items.begin(), items.end(), item) != items.end())
      throw cli::UsageError(option + ": \"" + item + "\" stands there twice");
    items.push_back(item);
  }
  return items;
}

std::vector<std::uint64_t> wholeNumbersOf(const std::string& option, const std::string& list)
{
  std::vector<std::uint64_t> seeds;
  for (const auto& item : itemsOf(option, list))
  {
    if (item.size() > 18 || item.find_first_not_of("0123456789") != std::string::npos)
      throw cli::UsageError(option + ": \"" + item + "\" is not a whole number");
    seeds.push_back(std::stoull(item));
  }
  return seeds;
}

constexpr std::uint64_t kMostRooms = 100000;

unsigned roomsOf(const std::string& count)
{
  const auto numbers = wholeNumbersOf("--rooms", count);
  if (numbers.size() != 1 || numbers[0] > kMostRooms)
    throw cli::UsageError(
        "--rooms: \"" + count + "\" is not one whole number up to " + std::to_string(kMostRooms));
  return static_cast<unsigned>(numbers[0]);
}

/** Those methods that quadmap-slam has. */
std::vector<std::string> knownMethods(const std::string& list)
{
  std::vector<std::string> known;
  for (const auto& method : itemsOf("--methods", list)) try
    {
      slamMethodFrom(method);
      known.push_back(method);
    }
    catch (const std::invalid_argument&)
    {
      std::cerr << "quadmap-benchmark: left out: quadmap-slam has no method " << method << "\n";
    }
  return known;
}

/** Command `jobs`: prints the list of jobs. */
void jobsCommand(int argc, char** argv)
{
  cli::CommandLine line(
      "quadmap-benchmark jobs", "Prints the jobs of a benchmark, one a line.", QUADMAP_VERSION);
  line.addExample(
      "quadmap-benchmark jobs --scenes home,office --seeds 1,2", "Lists the jobs of two scenes.");
  const auto list = [&](const char* name, const char* what, const char* standard)
  {
    line.allowEmpty(name);
    return std::make_unique<TCLAP::ValueArg<std::string>>(
        "", name, what, false, standard, "A,B,...", line.args());
  };
  const auto scenes = list(
      "scenes", "Scenes to map; '' for none.",
      "home,office,robot-home,robot-home-four,cluttered-desk,corridor,lifelong,approach");
  const auto observed = list(
      "observed",
      "Scenes whose single frames are measured; '' for none (default: these, if mapped).",
      "home,office,cluttered-desk");
  const auto recordings = list("recordings", "Real recordings, by the names of their folders.", "");
  const auto seeds = list("seeds", "Of the simulations.", "1,2,3,4,5");
  const auto methods = list("methods", "Of quadmap-slam.", "odometry,rgbd,quadric,point");
  TCLAP::ValueArg<std::string> rooms{
      "",
      "rooms",
      "Random rooms, each another one, mapped with rgbd (default: 20, or none if --scenes is "
      "given).",
      false,
      "20",
      "N",
      line.args()};
  if (!line.parse(argc, argv)) return;
  BenchmarkPlan plan{
      itemsOf("--scenes", scenes->getValue()),
      itemsOf("--observed", observed->getValue()),
      itemsOf("--recordings", recordings->getValue()),
      wholeNumbersOf("--seeds", seeds->getValue()),
      knownMethods(methods->getValue()),
      scenes->isSet() && !rooms.isSet() ? 0 : roomsOf(rooms.getValue())};
  if (!observed->isSet())  // without it only scenes that are mapped are measured
    plan.observedScenes.erase(
        std::remove_if(
            plan.observedScenes.begin(), plan.observedScenes.end(),
            [&](const std::string& scene) {
              return std::find(plan.scenes.begin(), plan.scenes.end(), scene) == plan.scenes.end();
            }),
        plan.observedScenes.end());
  for (const auto& job : jobsOf(plan)) std::cout << job.line() << "\n";
}

/** The value of "KEY : value" (or KEY=value) in a system file. */
std::string entryOf(const char* file, const std::string& key, char separator)
{
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
  {
    const auto at = line.find(separator);
    if (line.rfind(key, 0) != 0 || at == std::string::npos) continue;
    const auto begin = line.find_first_not_of(" \t\"", at + 1);
    const auto end = line.find_last_not_of(" \t\"");
    return begin == std::string::npos ? "" : line.substr(begin, end + 1 - begin);
  }
  return "unknown";
}

/** "6.18.44" for "6.18.44-amd64". */
std::string releaseNumbers(const std::string& release)
{
  return release.substr(0, release.find_first_not_of("0123456789."));
}

/** Command `machine`: prints what the figures depend on beside the code. */
void machineCommand(int argc, char** argv)
{
  cli::CommandLine line(
      "quadmap-benchmark machine", "Prints what machine and program this is, as JSON.",
      QUADMAP_VERSION);
  line.addExample("quadmap-benchmark machine --commit abc1234", "Prints it with a commit.");
  TCLAP::ValueArg<std::string> commit{
      "", "commit", "Which commit the programs were built from.", false, "", "ID", line.args()};
  if (!line.parse(argc, argv)) return;
  constexpr double kBytesPerGb = 1e9;
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGESIZE)) / kBytesPerGb;
  utsname kernel{};
  uname(&kernel);
  Json json;
  json["format"] = "quadmap-machine";
  json["version"] = 1;
  json["processor"] = entryOf("/proc/cpuinfo", "model name", ':');
  json["cores"] = sysconf(_SC_NPROCESSORS_ONLN);
  json["memory_gb"] = std::lround(memory);
  json["system"] = entryOf("/etc/os-release", "PRETTY_NAME", '=') + ", " + kernel.sysname + " " +
                   releaseNumbers(kernel.release);
#ifdef __clang__
  json["compiler"] = "Clang " __clang_version__;
#else
  json["compiler"] = "GCC " __VERSION__;
#endif
  json["program"] = "quadmap " QUADMAP_VERSION;
  if (commit.isSet()) json["commit"] = commit.getValue();
  std::cout << jsonText(json, 2) << "\n";
}

/** Section "pictures": every plot as an image of the page, with its title. */
std::string pictureSection(
    const std::map<std::string, Picture>& plots, const fs::path& folder, const fs::path& page)
{
  std::string text;
  const fs::path from = fs::absolute(page).parent_path();
  for (const auto& [name, picture] : plots)
    text += "![" + picture.title + "](" +
            fs::absolute(folder / name).lexically_relative(from).generic_string() + ")\n";
  return text;
}

void writePictures(
    const std::map<std::string, Picture>& plots, const std::string& folder, OutputGroup& files)
{
  OutputSet& set = files.addFolder(folder, "plots");
  for (const auto& [name, picture] : plots) writeTextFile(set.add(name), picture.svg);
}

/** Command `merge`: makes tables and plots from the results. */
void mergeCommand(int argc, char** argv)
{
  cli::CommandLine line(
      "quadmap-benchmark merge",
      "Makes the tables of a page, between its markers <!-- generated: NAME -->, and the plots "
      "from all results that are there. Without --page the tables are printed.",
      QUADMAP_VERSION);
  line.addExample(
      "quadmap-benchmark merge results --page doc/benchmarks.md --plots doc/benchmarks",
      "Writes tables and pictures of a page.");
  TCLAP::UnlabeledValueArg<std::string> results{
      "RESULTS", "Folder with the results.", true, "", "RESULTS", line.args()};
  TCLAP::ValueArg<std::string> page{
      "", "page", "The page to bring up to date.", false, "", "FILE.md", line.args()};
  TCLAP::ValueArg<std::string> plots{
      "",
      "plots",
      "Where the plots go; made when missing. Without it none are made, and those of the page "
      "stay.",
      false,
      "",
      "FOLDER",
      line.args()};
  if (!line.parse(argc, argv)) return;

  const BenchmarkResults found = readBenchmarkResults(results.getValue());
  auto sections = benchmarkTables(found);
  OutputGroup files;
  std::map<std::string, Picture> pictures;
  if (plots.isSet())
  {
    pictures = benchmarkPlots(found);
    writePictures(pictures, plots.getValue(), files);
  }
  if (page.isSet())
  {
    const auto in = openModestText(page.getValue());
    std::ostringstream text;
    text << in.rdbuf();
    std::set<std::string> kept;
    if (plots.isSet())
      sections["pictures"] = pictureSection(pictures, plots.getValue(), page.getValue());
    else
      kept.insert("pictures");
    writeTextFile(files.add(page.getValue()), withGeneratedSections(text.str(), sections, kept));
  }
  files.commit();
  if (!page.isSet())
    for (const auto& [name, text] : sections) std::cout << "## " << name << "\n\n" << text << "\n";
  for (const auto& job : found.missing)
    std::cerr << "quadmap-benchmark: no result of: " << job << "\n";
}

}  // namespace

int main(int argc, char** argv)
{
  return cli::runSubcommands(
      "quadmap-benchmark",
      "Lists the jobs of the benchmark and merges their results; share/quadmap/benchmark/run does "
      "all of it.",
      {
          {   "jobs",    jobsCommand},
          {"machine", machineCommand},
          {  "merge",   mergeCommand}
  },
      argc, argv);
}
