#include <cstdio>
#include <filesystem>
#include <iostream>

#include "../common/CommandLine.h"
#include "CameraInput.h"
#include "SlamCli.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/review/KeyframeContent.h"
#include "quadmap/review/ReportPage.h"
#include "quadmap/review/SceneBuilder.h"
#include "quadmap/slam/PoseNodes.h"
#include "quadmap/slam/RawlogRun.h"

namespace
{
using namespace quadmap;

/** Options of the scene's cloud. It is coarser than by default, which saves half of the time: every
 * run writes a scene, but few are looked at closely. */
CloudOptions sceneCloud()
{
  CloudOptions cloud;
  cloud.cellSize = 0.02;
  cloud.maxPoints = 300000;
  cloud.maxKeyframes = 60;
  return cloud;
}

/** Writes scene.3Dscene. The cloud comes from map.simplemap, one keyframe at a time.
 *  \param simpleMap Path of that file. */
void writeSceneOf(const SlamResult& result, const std::string& simpleMap, const std::string& path)
{
  SceneContent content;
  content.objects = result.map.toRecords();
  for (const auto& node : poseNodesOf(result.keyframes))
    content.trajectory.push_back(node.T_map_robot);
  addKeyframes(simpleMap, sceneCloud(), content);
  writeScene(*SceneBuilder().scene(content), path);
}

void printObjects(const std::vector<ObjectRecord>& objects)
{
  std::printf("%5s  %-16s %24s %21s %6s\n", "id", "label", "centre [m]", "size [m]", "seen");
  for (const auto& o : objects)
  {
    const Eigen::Vector3d p = o.object.center(), size = 2 * o.object.semiAxes();
    std::printf(
        "%5s  %-16s %8.3f%8.3f%8.3f %7.3f%7.3f%7.3f %6u\n", o.id.c_str(), o.label.c_str(), p.x(),
        p.y(), p.z(), size.x(), size.y(), size.z(), o.observations.value_or(0));
  }
}

void printChanges(const MapContinuation& changes)
{
  for (const auto& move : changes.moved)
    std::printf("moved: object %u is now %u, %.2f m away\n", move.from, move.to, move.distance);
  for (const ObjectId id : changes.removed) std::printf("removed: object %u\n", id);
  for (const ObjectId id : changes.added) std::printf("added: object %u\n", id);
}

void printSummary(const RawlogRunSummary& summary)
{
  const auto& bySensor = summary.result.countsBySensor;
  const auto counts = summary.result.counts();
  printObjects(summary.result.map.toRecords());
  if (summary.result.continuation) printChanges(*summary.result.continuation);
  if (bySensor.size() > 1)
    for (const auto& [sensor, c] : bySensor)
      std::printf(
          "%s: %zu frames, %zu keyframes, %zu boxes\n", sensor.c_str(), c.frames, c.keyframes,
          c.boxes);
  std::printf(
      "%zu frames, %zu keyframes, %zu boxes, %zu objects\n", counts.frames, counts.keyframes,
      counts.boxes, summary.result.map.confirmedObjects().size());
  for (const auto& name : summary.files)
    std::printf("wrote %s/%s\n", summary.directory.c_str(), name.c_str());
}

/** Runs it. \return The exit status. \exception RunStoppedEarly See runOnRawlog(). */
int run(SlamCli& cli)
{
  if (cli.defaults.isSet()) throw cli::UsageError("--defaults: must be given alone");
  RawlogRunRequest request;
  request.rawlog = cli.rawlog.getValue();
  request.outputDirectory = cli.output.getValue();
  request.objectsFile = cli.objects.getValue();
  request.sensorLabel = cli.sensor.getValue();
  request.keepGoing = cli.keepGoing.getValue();
  request.replaceComplete = cli.replace.getValue();
  request.configuration = configurationOf(cli);
  if (cli.map.isSet())
  {
    request.mapFile = mapFileOf(cli.map.getValue());
    request.map = std::make_shared<CQuadricObjectMap>(readMap(request.mapFile));
  }
  request.version = QUADMAP_VERSION;
  const auto verbosity = cli.line.verbosity();
  std::vector<std::string> notes;
  request.onMessage =
      [verbosity, &notes](mrpt::system::VerbosityLevel level, const std::string& text)
  {
    if (level < verbosity) return;
    if (level == mrpt::system::LVL_INFO && verbosity == mrpt::system::LVL_INFO)
      notes.push_back(text);  // they are printed when the run succeeds
    else
      std::cerr << "quadmap-slam: " << (level == mrpt::system::LVL_WARN ? "warning: " : "")
                << oneLine(text) << "\n";
  };
  request.shouldStop = [] { return cli::stopSignal != 0; };
  request.onClosing = [] { cli::onStop = cli::OnStop::Defer; };  // writing is short
  request.addFiles = [](const SlamResult& result, OutputSet& files)
  {
    writeSceneOf(result, files.written("map.simplemap"), files.add("scene.3Dscene"));
    const std::string folder = std::filesystem::path(files.written("report.json")).parent_path();
    writeTextFile(files.add("report.html"), reportPage(folder));
  };
  cli::onStop = cli::OnStop::Note;
  CameraInput camera(request, cli.camera, cli.cameraName);

  const RawlogRunSummary summary = runOnRawlog(request);
  camera.end();
  for (const auto& note : notes) std::printf("%s\n", note.c_str());
  if (verbosity <= mrpt::system::LVL_INFO) printSummary(summary);
  for (const auto& what : summary.dropped) std::cerr << "quadmap-slam: left out: " << what << "\n";
  if (!summary.interrupted) return 0;
  if (camera.failure())
  {
    std::cerr << "quadmap-slam: " << *camera.failure() << "; the files hold what was done\n";
    return 1;
  }
  std::cerr << "quadmap-slam: interrupted, the files hold what was done\n";
  return 128 + cli::stopSignal;  // the exit status by which shells report a signal
}

int runToTheEndOrStop(SlamCli& cli)
try
{
  return run(cli);
}
catch (const RunStoppedEarly& e)
{
  std::cerr << "quadmap-slam: " << oneLine(e.what()) << "\n";
  return 128 + cli::stopSignal;  // as of a run that has something to write
}

}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-slam",
      [&]
      {
        if (cli::asksForDefaults(argc, argv))
        {
          std::cout << SlamConfiguration().documentedIni();
          return 0;
        }
        SlamCli cli;
        return cli.line.parse(argc, argv) ? runToTheEndOrStop(cli) : 0;
      });
}
