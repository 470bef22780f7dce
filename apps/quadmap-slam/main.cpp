#include <cstdio>
#include <filesystem>
#include <iostream>

#include "../common/CommandLine.h"
#include "../common/ReplaceArgument.h"
#include "CameraInput.h"
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

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "quadmap-slam",
      "Makes the trajectory and the object map of an RGB-D rawlog or of a camera. Boxes come from "
      "the rawlog, from NAME.objects.rawlog beside it, or from --detector. Ctrl-C ends a camera. "
      "It "
      "stops a recording early: the files then hold what was done, and the exit status is 130 (143 "
      "after SIGTERM). A second one ends at once and changes nothing.",
      QUADMAP_VERSION};
  std::vector<std::string> methodNames{"rgbd", "quadric", "point", "odometry"};
  std::vector<std::string> associationNames{"estimated", "given"};
  TCLAP::ValuesConstraint<std::string> methods{methodNames}, associations{associationNames};
  TCLAP::UnlabeledValueArg<std::string> rawlog{
      "rawlog",
      "The recording, in either format of MRPT; or openni2:live, the plugged-in camera, or "
      "openni2:FILE.oni, a recording of one.",
      true,
      "",
      "IN.rawlog|openni2:...",
      line.args()};
  cli::Example mapping{
      line, "quadmap-slam home.rawlog -o home",
      "Maps a recording with its own odometry and the boxes of home.objects.rawlog."};
  cli::Example detecting{
      line, "quadmap-slam openni2:live -o desk --detector nanodet-m",
      "Maps from a camera until Ctrl-C; a neural network finds the boxes."};
  cli::Example continuing{
      line, "quadmap-slam today.rawlog -o today --map yesterday/objects.quadmap",
      "Starts in an earlier map and reports what changed."};
  cli::Group results{line, "Results and options"};
  TCLAP::ValueArg<std::string> output{
      "o", "output", "Folder for the results; made when missing.", true, "", "OUTDIR", line.args()};
  TCLAP::ValueArg<std::string> config{
      "c",        "config",   "Options; share/quadmap/quadmap.ini lists them all.", false, "",
      "FILE.ini", line.args()};
  TCLAP::SwitchArg defaults{
      "", "defaults",
      "Given alone: print the options that --config takes, with their defaults and what they do.",
      line.args()};
  cli::Group methodGroup{line, "Method"};
  TCLAP::ValueArg<std::string> method{
      "",
      "method",
      "rgbd: objects from boxes and depth; quadric: from box edges alone, as QuadricSLAM, for "
      "comparison; point: from the centres of the measurements alone, for comparison; odometry: "
      "the "
      "trajectory alone.",
      false,
      "rgbd",
      &methods,
      line.args()};
  TCLAP::ValueArg<std::string> odometry{
      "",
      "odometry",
      "Where poses come from: the rawlog's odometry, visual odometry from the images, the rawlog's "
      "ground truth, the nodes of a pose graph, each image that has one being a keyframe; auto: "
      "the "
      "rawlog's odometry or, without any, visual odometry; images of one moment need none.",
      false,
      "auto",
      "auto|rawlog|visual|ground-truth|graph:FILE",
      line.args()};
  TCLAP::ValueArg<std::string> association{
      "",
      "association",
      "Which object a box shows. estimated: from labels, positions and sizes; given: by the "
      "instance ids of the boxes.",
      false,
      "estimated",
      &associations,
      line.args()};
  TCLAP::ValueArg<std::string> map{
      "",
      "map",
      "Start in this map of an earlier run, its folder or a file of a map: the place is found from "
      "the objects, results are in the map's frame, and OUTDIR/objects.quadmap is the map brought "
      "up to date.",
      false,
      "",
      "MAP",
      line.args()};
  cli::Group inputGroup{line, "Input"};
  TCLAP::ValueArg<std::string> objects{
      "", "objects", "The file with the boxes.", false, "", "FILE.rawlog", line.args()};
  TCLAP::ValueArg<std::string> detector{
      "",
      "detector",
      "Find the boxes of the keyframes with this model, whatever boxes the input has: its name "
      "(see "
      "quadmap-detect --list) or its model file (.ini; see quadmap-detect --help).",
      false,
      "",
      "NAME|FILE",
      line.args()};
  TCLAP::ValueArg<std::string> sensor{"",      "sensor",   "Use only this RGB-D sensor.", false, "",
                                      "LABEL", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Leave out broken records and say so, instead of failing.", line.args()};
  cli::Group running{line, "Running"};
  cli::ReplaceArgument replace{line.args()};
  TCLAP::ValueArg<int> every{
      "",  "every",    "Every n-th frame of a sensor is a keyframe (default: by motion).", false, 0,
      "N", line.args()};
  TCLAP::ValueArg<int> threads{
      "",
      "threads",
      "Threads that work; 0 or none: as many as useful. The results are the same with any number.",
      false,
      0,
      "N",
      line.args()};
  cli::Group cameraGroup{line, "Camera"};
  cli::CameraArguments camera{line.args()};
  TCLAP::ValueArg<std::string> cameraName{
      "",
      "camera",
      "openni2: the calibration of a known camera, scaled to the images (a name of "
      "share/quadmap/cameras or a file), instead of the field of view that the camera states.",
      false,
      "",
      "NAME|FILE",
      line.args()};
};

/** Sets an option by its setter. An error names the option as the command line does. */
template <typename Value>
void set(SlamOptions& options, void (SlamOptions::*setter)(Value), Value value)
try
{
  (options.*setter)(value);
}
catch (const std::invalid_argument& e)
{
  throw cli::UsageError("--" + std::string(e.what()));
}

SlamConfiguration configurationOf(Cli& cli)
{
  SlamConfiguration configuration;
  if (cli.config.isSet()) configuration = SlamConfiguration::fromFile(cli.config.getValue());
  if (cli.method.isSet()) configuration.slam.method = slamMethodFrom(cli.method.getValue());
  if (cli.odometry.isSet())
    set<const std::string&>(configuration.slam, &SlamOptions::setOdometry, cli.odometry.getValue());
  if (cli.association.isSet())
    configuration.slam.association = associationSourceFrom(cli.association.getValue());
  if (cli.detector.isSet()) configuration.slam.detector = cli.detector.getValue();
  if (cli.objects.isSet() && configuration.slam.findsBoxes())
    throw cli::UsageError("--objects: not with a detector, which finds the boxes");
  if (cli.every.isSet())
  {
    if (cli.every.getValue() < 1) throw cli::UsageError("--every: must be 1 or more");
    configuration.keyframes.every = cli.every.getValue();
  }
  if (cli.threads.isSet())
    set<int>(configuration.slam, &SlamOptions::setThreads, cli.threads.getValue());
  return configuration;
}

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

int run(Cli& cli)
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
  request.onClosing = []
  { cli::onStop = cli::OnStop::Defer; };  // so short that nothing need be lost
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
        Cli cli;
        return cli.line.parse(argc, argv) ? run(cli) : 0;
      });
}
