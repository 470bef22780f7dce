#include <mrpt/core/format.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "../common/CommandLine.h"
#include "../common/KeptFiles.h"
#include "../common/ProgressBar.h"
#include "../common/SeveralOutputs.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/rooms/RandomRoom.h"
#include "quadmap/simulator/Simulator.h"

namespace
{
using namespace quadmap;

constexpr int kFewestFrames = 2, kMostFrames = 100000;

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "quadmap-simulate",
      "Moves through a furnished room with simulated RGB-D cameras and an object detector. Writes "
      "the rawlog (range scans, drifting odometry, true poses), the boxes (OUT.objects.rawlog), "
      "the true objects (OUT.objects.gt.json) and the true trajectory (OUT.groundtruth.tum). The "
      "same arguments give the same bytes.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> scene{
      "SCENE",
      "Name of an installed scene (home), the path of a scene file, or random: another furnished "
      "room, camera and detector for each seed.",
      true,
      "",
      "SCENE",
      line.args()};
  cli::Example walk{
      line, "quadmap-simulate home -o room.rawlog --seed 7", "Walks through a furnished room."};
  cli::Example other{
      line, "quadmap-simulate random -o room.rawlog --seed 7 --resolution 320x240",
      "Walks through the seventh random room."};
  cli::Group outputGroup{line, "Output"};
  TCLAP::ValueArg<std::string> output{"o",          "output",   "The rawlog to write.", true, "",
                                      "OUT.rawlog", line.args()};
  TCLAP::ValueArg<std::string> seed{
      "",
      "seed",
      "Another number, another recording of the same walk (and another random room).",
      false,
      "1",
      "N",
      line.args()};
  TCLAP::ValueArg<std::string> sceneFile{
      "",
      "write-scene",
      "Writes a random room as a scene file as well, to look at or change.",
      false,
      "",
      "ROOM.ini",
      line.args()};
  cli::Group errors{line, "Errors of the sensors"};
  TCLAP::ValueArg<std::string> noise{
      "",         "noise", "Multiplies all errors of the sensors, 0 to 10; 0 = perfect sensors.",
      false,      "1",     "FACTOR",
      line.args()};
  TCLAP::ValueArg<std::string> depthNoise{
      "",       "depth-noise", "The same for the errors of depth, instead of --noise.", false, "",
      "FACTOR", line.args()};
  TCLAP::ValueArg<std::string> odometryNoise{
      "",
      "odometry-noise",
      "The same for the drift of odometry, instead of --noise.",
      false,
      "",
      "FACTOR",
      line.args()};
  TCLAP::ValueArg<std::string> detectorNoise{
      "",
      "detector-noise",
      "The same for jitter, misses, wrong labels and false alarms of the detector, instead of "
      "--noise.",
      false,
      "",
      "FACTOR",
      line.args()};
  cli::Group images{line, "Images"};
  TCLAP::ValueArg<std::string> frames{
      "",         "frames", "Images of each camera instead of the scene's, for the same walk.",
      false,      "",       "N",
      line.args()};
  TCLAP::ValueArg<std::string> rate{
      "",
      "rate",
      "Images per second of each camera [Hz], for the same walk in the same time; instead of "
      "--frames.",
      false,
      "",
      "HZ",
      line.args()};
  TCLAP::ValueArg<std::string> resolution{
      "",    "resolution", "Image size instead of the scene's, same width of view.", false, "",
      "WxH", line.args()};
  cli::Group detector{line, "Detector"};
  TCLAP::ValueArg<std::string> detections{
      "",
      "detections",
      "What the detector gives instead of what the scene says: boxes; boxes with masks; or labels "
      "of pixels in the range scans, named by classes or instances.",
      false,
      "boxes",
      "boxes|masks|classes|instances",
      line.args()};
  TCLAP::SwitchArg instanceIds{
      "", "instance-ids", "The boxes say which object they show; false alarms do not.",
      line.args()};
};

simulator::DetectorOutput detectorOutput(const std::string& name)
{
  const auto output = simulator::detectorOutputOf(name);
  if (!output)
    throw cli::UsageError("--detections " + name + ": must be boxes, masks, classes or instances");
  return *output;
}

/** A whole number that the user typed. \exception cli::UsageError If it is none. */
unsigned long long wholeNumber(
    const std::string& option,
    const std::string& text,
    unsigned long long min,
    unsigned long long max)
{
  const bool digits = !text.empty() && text.size() <= 18 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  const unsigned long long value = digits ? std::stoull(text) : 0;
  if (!digits || value < min || value > max)
    throw cli::UsageError(mrpt::format(
        "%s %s: must be a whole number in [%llu, %llu]", option.c_str(), text.c_str(), min, max));
  return value;
}

/** A number that the user typed. \exception cli::UsageError If it is none. */
double number(const std::string& option, const std::string& text, double min, double max)
{
  const auto value = parseNumber(text);
  if (!value || !(*value >= min && *value <= max))
    throw cli::UsageError(mrpt::format(
        "%s %s: must be a number in [%g, %g]", option.c_str(), text.c_str(), min, max));
  return *value;
}

simulator::NoiseFactors noiseFactors(Cli& cli)
{
  const auto factorOf = [](TCLAP::ValueArg<std::string>& arg)
  { return number("--" + arg.getName(), arg.getValue(), 0, 10); };
  auto factors = simulator::NoiseFactors::all(factorOf(cli.noise));
  if (cli.depthNoise.isSet()) factors.depth = factorOf(cli.depthNoise);
  if (cli.odometryNoise.isSet()) factors.odometry = factorOf(cli.odometryNoise);
  if (cli.detectorNoise.isSet()) factors.detector = factorOf(cli.detectorNoise);
  return factors;
}

/** Sets how many images are taken, by their number or by their rate. The way and its duration stay
 * those of the scene. */
void setFrames(Cli& cli, simulator::TrajectoryOptions& trajectory)
{
  if (cli.frames.isSet() && cli.rate.isSet())
    throw cli::UsageError("--rate: give either --rate or --frames, rate = frames / duration");
  if (cli.frames.isSet())
    trajectory.frames = static_cast<int>(
        wholeNumber("--frames", cli.frames.getValue(), kFewestFrames, kMostFrames));
  if (!cli.rate.isSet()) return;
  const double rate = number(
      "--rate", cli.rate.getValue(), kFewestFrames / trajectory.duration,
      kMostFrames / trajectory.duration);
  trajectory.frames = static_cast<int>(std::lround(rate * trajectory.duration));
}

void setResolution(const std::string& text, simulator::SimulatorOptions& options)
{
  const auto x = text.find('x');
  if (x == std::string::npos)
    throw cli::UsageError("--resolution " + text + ": expected WIDTHxHEIGHT, such as 320x240");
  const auto width = wholeNumber("--resolution", text.substr(0, x), 64, 4096);
  const auto height = wholeNumber("--resolution", text.substr(x + 1), 64, 4096);
  options.resize(static_cast<int>(width), static_cast<int>(height));
}

void report(const std::string& file, const simulator::SimulationSummary& summary, std::ostream& out)
{
  out << file << ": " << summary.frames << " frames, " << summary.boxes << " boxes of "
      << summary.truth.size() << " objects\n";
  for (const auto& object : summary.truth)
    if (object.framesVisible.value_or(0) == 0)
      out << "note: object " << object.id << " (" << object.label << ") is never seen\n";
}

/** The files that are written, with the option that names them. */
cli::NamedOutputs outputsOf(Cli& cli)
{
  const simulator::SimulationFiles files(cli.output.getValue());
  cli::NamedOutputs outputs;
  for (const auto& file : {files.rawlog, files.boxes, files.truth, files.trajectory})
    outputs.emplace_back("-o", file);
  if (cli.sceneFile.isSet()) outputs.emplace_back("--write-scene", cli.sceneFile.getValue());
  return outputs;
}

/** The scene that the user asks for. A random room is another one for each seed. */
simulator::Scene sceneOf(Cli& cli, std::uint64_t seed)
{
  const std::string& name = cli.scene.getValue();
  if (name == simulator::kRandomRoom) return simulator::randomRoom(seed);
  if (cli.sceneFile.isSet())
    throw cli::UsageError(
        "--write-scene: only for the scene " + std::string(simulator::kRandomRoom));
  return simulator::readScene(simulator::findScene(name));
}

/** \exception cli::UsageError If two outputs are one file, or one would replace the scene that is
 * read. */
void checkOutputs(Cli& cli)
{
  const cli::NamedOutputs outputs = outputsOf(cli);
  cli::requireDifferentFiles(outputs);
  const std::string& name = cli.scene.getValue();
  if (name == simulator::kRandomRoom) return;
  cli::KeptFiles kept;
  kept.add(simulator::findScene(name));
  for (const auto& [option, output] : outputs) kept.requireNone(option, output);
}

/** The scene file that is written beside the recording, if one is asked for. */
std::optional<simulator::TextBeside> sceneFileOf(Cli& cli, const simulator::Scene& scene)
{
  if (!cli.sceneFile.isSet()) return std::nullopt;
  return simulator::TextBeside{cli.sceneFile.getValue(), simulator::sceneText(scene)};
}

/** \exception std::runtime_error If no camera can go the scene's way; names its file. */
simulator::Simulator simulatorOf(
    simulator::Scene scene, const std::string& nameOrPath, std::uint64_t seed)
try
{
  return simulator::Simulator(std::move(scene), LabelTable::installed(), seed);
}
catch (const std::runtime_error& e)
{
  const bool isRandom = nameOrPath == simulator::kRandomRoom;
  throw std::runtime_error(
      (isRandom ? nameOrPath : simulator::findScene(nameOrPath)) + ": " + e.what());
}

void run(Cli& cli)
{
  checkOutputs(cli);
  std::ostream& messages = cli::messagesBeside(outputsOf(cli));
  const auto seed = wholeNumber("--seed", cli.seed.getValue(), 0, 999999999999999999ULL);
  const simulator::NoiseFactors noise = noiseFactors(cli);
  simulator::Scene scene = sceneOf(cli, seed);
  const auto sceneFile = sceneFileOf(cli, scene);  // of the room, whatever images are taken in it
  setFrames(cli, scene.options.trajectory);
  if (cli.resolution.isSet()) setResolution(cli.resolution.getValue(), scene.options);
  if (cli.detections.isSet())
    scene.options.detector.output = detectorOutput(cli.detections.getValue());
  if (cli.instanceIds.isSet()) scene.options.detector.instanceIds = true;
  scene.options.scaleNoise(noise);

  const auto simulator = simulatorOf(std::move(scene), cli.scene.getValue(), seed);
  const std::string& output = cli.output.getValue();
  report(
      output, simulator::simulateToFiles(simulator, output, cli::ProgressBar(), sceneFile),
      messages);
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-simulate",
      [&]
      {
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
