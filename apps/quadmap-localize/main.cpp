#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>

#include "../common/CommandLine.h"
#include "../common/ProgressBar.h"
#include "../common/ReplaceArgument.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/RunFolder.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/navigation/LocalizationRun.h"

namespace
{
using namespace quadmap;

constexpr int kMostThreads = 64;
constexpr const char* kReport = "localization.json";
constexpr const char* kTrajectory = "localization.tum";
constexpr unsigned kUsefulThreads = 4;  // beyond these the images take all of the time

/** The arguments of the program. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-localize",
      "Finds the robot of an RGB-D rawlog in a map of objects, from anywhere in it, with a "
      "particle filter, and follows it. The map stays as it is. Boxes come from the rawlog or from "
      "NAME.objects.rawlog beside it. The status is 1 when the robot was not found, or is lost in "
      "the end. Ctrl-C stops "
      "early: the files then hold what was done, and the exit status is 130 (143 after SIGTERM).",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> rawlog{
      "rawlog", "The recording, in either format of MRPT.", true, "", "IN.rawlog", line.args()};
  cli::Example finding{
      line, "quadmap-localize today.rawlog --map home -o today",
      "Writes the poses of the robot in the map of an earlier run."};
  cli::Group results{line, "Results and options"};
  Text map{"",    "map",      "The map: the folder of a run, or a file of a map.", true, "",
           "MAP", line.args()};
  Text output{"o",      "output",   "Folder for the results; made when missing.", true, "",
              "OUTDIR", line.args()};
  Text config{"c",        "config",   "Options; --defaults prints them all.", false, "",
              "FILE.ini", line.args()};
  TCLAP::SwitchArg defaults{
      "", "defaults",
      "Given alone: print the options that --config takes, with their defaults and what they do.",
      line.args()};
  cli::Group filter{line, "Filter"};
  TCLAP::ValueArg<int> particles{
      "",         "particles", "Number of poses that are weighed, instead of the configuration's.",
      false,      2000,        "N",
      line.args()};
  TCLAP::ValueArg<int> seed{
      "",  "seed",     "Seed of the random numbers, instead of the configuration's.", false, 1,
      "N", line.args()};
  Text odometry{
      "",
      "odometry",
      "Where the motion comes from: the rawlog's odometry, visual odometry from the images, the "
      "rawlog's ground truth; auto: the rawlog's odometry or, without any, visual odometry.",
      false,
      "auto",
      "auto|rawlog|visual|ground-truth",
      line.args()};
  cli::Group inputGroup{line, "Input"};
  Text objects{"", "objects", "The file with the boxes.", false, "", "FILE.rawlog", line.args()};
  Text sensor{"", "sensor", "Use only this RGB-D sensor.", false, "", "LABEL", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Leave out broken records and say so, instead of failing.", line.args()};
  cli::Group running{line, "Running"};
  cli::ReplaceArgument replace{line.args()};
  TCLAP::ValueArg<int> threads{
      "",
      "threads",
      "Threads that weigh poses; 0 or none: as many as useful. The results are the same with any "
      "number.",
      false,
      0,
      "N",
      line.args()};
};

LocalizationConfiguration configurationOf(Cli& cli)
{
  LocalizationConfiguration configuration;
  if (cli.config.isSet())
    configuration = LocalizationConfiguration::fromFile(cli.config.getValue());
  auto& options = configuration.localization;
  if (cli.particles.isSet()) options.particles = cli.particles.getValue();
  if (cli.seed.isSet()) options.seed = cli.seed.getValue();
  if (options.particles < 100 || options.particles > 1000000)
    throw cli::UsageError("--particles: must be between 100 and 1000000");
  if (options.seed < 0) throw cli::UsageError("--seed: must be 0 or more");
  return configuration;
}

PoseSource odometryOf(Cli& cli)
try
{
  const PoseSource source = poseSourceFrom(cli.odometry.getValue());
  if (source == PoseSource::Graph)
    throw std::invalid_argument("odometry=" + cli.odometry.getValue() + ": not a pose graph");
  return source;
}
catch (const std::invalid_argument& e)
{
  throw cli::UsageError("--" + std::string(e.what()));
}

std::size_t threadsOf(Cli& cli)
{
  const int wanted = cli.threads.getValue();
  if (wanted < 0 || wanted > kMostThreads)
    throw cli::UsageError(mrpt::format("--threads: must be between 0 and %d", kMostThreads));
  if (wanted > 0) return static_cast<std::size_t>(wanted);
  return std::clamp(std::thread::hardware_concurrency(), 1U, kUsefulThreads);
}

LocalizationRequest requestOf(Cli& cli)
{
  LocalizationRequest request;
  request.rawlog = cli.rawlog.getValue();
  request.objectsFile = cli.objects.getValue();
  request.sensorLabel = cli.sensor.getValue();
  request.keepGoing = cli.keepGoing.getValue();
  request.odometry = odometryOf(cli);
  request.configuration = configurationOf(cli);
  request.threads = threadsOf(cli);
  request.mapFile = mapFileOf(cli.map.getValue());
  request.map = std::make_shared<CQuadricObjectMap>(readMap(request.mapFile));
  request.onWarning = [](const std::string& text)
  { std::cerr << "quadmap-localize: warning: " << oneLine(text) << "\n"; };
  request.shouldStop = [] { return cli::stopSignal != 0; };
  return request;
}

void write(
    Cli& cli,
    const LocalizationRequest& request,
    const LocalizationResult& result,
    RunFolder& folder)
{
  if (result.interrupted && !cli.replace.getValue())
    if (const auto warning = folder.keepCompleteResult(); !warning.empty())
      request.onWarning(warning);
  OutputSet& files = folder.files();
  writeTumTrajectory(files.add(kTrajectory), result.trajectory());
  writeTextFile(files.add(kReport), localizationToJson(request, result, QUADMAP_VERSION));
  files.commit();
  if (cli.line.verbosity() > mrpt::system::LVL_INFO) return;
  for (const auto& name : files.names())
    std::printf("wrote %s/%s\n", files.folder().c_str(), name.c_str());
}

/** Since when the robot is localised, and whether it was before. */
void printLocalised(const LocalizationResult& result)
{
  const auto& all = result.updates;
  const auto first = std::find_if(
      all.begin(), all.end(), [](const auto& update) { return update.estimate.isLocalised; });
  if (first == all.end())
  {
    std::printf("not localised yet\n");
    return;
  }
  const auto from = result.localisedFrom();
  const auto firstIndex = static_cast<std::size_t>(first - all.begin());
  if (from != firstIndex)
    std::printf(
        "localised for the first time at update %zu, %.1f s after the first, and lost again\n",
        firstIndex + 1, first->time - all.front().time);
  if (from)
    std::printf(
        "localised from update %zu of %zu on, %.1f s after the first\n", *from + 1, all.size(),
        all[*from].time - all.front().time);
}

void printSummary(const LocalizationResult& result)
{
  printLocalised(result);
  if (result.updates.empty()) return;
  const auto updates = static_cast<double>(result.updates.size());
  const LocalizationEstimate& last = result.updates.back().estimate;
  std::printf(
      "%s: x %.3f m, y %.3f m, yaw %.1f deg, within %.3f m and %.1f deg\n",
      last.isLocalised ? "at the end" : "the best guess at the end", last.T_map_robot.x(),
      last.T_map_robot.y(), 180 / M_PI * last.T_map_robot.yaw(), last.sigma,
      180 / M_PI * last.yawSigma);
  std::printf(
      "%zu frames; %.1f updates/s by the filter alone, %.1f with looking at the images\n",
      result.frames, updates / result.filterSeconds,
      updates / (result.filterSeconds + result.measureSeconds));
}

int run(Cli& cli)
{
  if (cli.defaults.isSet()) throw cli::UsageError("--defaults: must be given alone");
  LocalizationRequest request = requestOf(cli);
  cli::onStop = cli::OnStop::Note;
  RunFolder folder(cli.output.getValue(), "localization", kReport, {kTrajectory});
  cli::ProgressBar bar;
  request.onProgress = [&bar](double share, const LocalizationEstimate& estimate)
  { bar(share, estimate.isLocalised ? " localised" : " searching"); };
  const LocalizationResult result = localiseInMap(request);
  cli::onStop = cli::OnStop::Defer;
  write(cli, request, result, folder);
  if (cli.line.verbosity() <= mrpt::system::LVL_INFO) printSummary(result);
  for (const auto& what : result.dropped)
    std::cerr << "quadmap-localize: left out: " << what << "\n";
  if (result.interrupted)
  {
    std::cerr << "quadmap-localize: interrupted, the files hold what was done\n";
    return 128 + cli::stopSignal;  // the exit status by which shells report a signal
  }
  if (result.localisedFrom()) return 0;
  std::cerr << "quadmap-localize: " << oneLine(request.rawlog)
            << ": the robot is lost in the end\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-localize",
      [&]
      {
        if (cli::asksForDefaults(argc, argv))
        {
          std::cout << LocalizationConfiguration().documentedIni();
          return 0;
        }
        Cli cli;
        return cli.line.parse(argc, argv) ? run(cli) : 0;
      });
}
