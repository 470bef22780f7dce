#include <mrpt/core/format.h>
#include <mrpt/system/progress.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "../common/CommandLine.h"
#include "quadmap/sensors/simulator/Simulator.h"

namespace
{
using namespace quadmap;

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "quadmap-simulate",
      "Moves through a furnished room with simulated RGB-D cameras and an object detector. Writes "
      "the rawlog (range scans, drifting odometry, true poses), the boxes (OUT.objects.rawlog), "
      "the "
      "true objects (OUT.objects.gt.json) and the true trajectory (OUT.groundtruth.tum). The same "
      "arguments give the same bytes.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> scene{
      "SCENE", "Name of an installed scene (home), or the path of a scene file.",
      true,    "",
      "SCENE", line.args()};
  TCLAP::ValueArg<std::string> output{"o",          "output",   "The rawlog to write.", true, "",
                                      "OUT.rawlog", line.args()};
  TCLAP::ValueArg<std::string> seed{
      "",  "seed",     "Another number, another recording of the same walk.", false, "1",
      "N", line.args()};
  TCLAP::ValueArg<std::string> noise{
      "",         "noise", "Multiplies all errors of the sensors, 0 to 10; 0 = perfect sensors.",
      false,      "1",     "FACTOR",
      line.args()};
  TCLAP::ValueArg<std::string> frames{
      "",         "frames", "Images of each camera instead of the scene's, for the same walk.",
      false,      "",       "N",
      line.args()};
  TCLAP::ValueArg<std::string> resolution{
      "",    "resolution", "Image size instead of the scene's, same width of view.", false, "",
      "WxH", line.args()};
  TCLAP::ValueArg<std::string> detections{
      "",
      "detections",
      "What the detector gives instead of what the scene says: boxes; boxes with masks; or labels "
      "of pixels in the range scans, named by classes or instances.",
      false,
      "boxes",
      "KIND",
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

/** A number the user typed. \exception cli::UsageError */
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

double noiseFactor(const std::string& text)
{
  double value = -1;
  int used = 0;
  const bool read = std::sscanf(text.c_str(), "%lf%n", &value, &used) == 1;
  if (!read || used != static_cast<int>(text.size()) || !(value >= 0 && value <= 10))
    throw cli::UsageError("--noise " + text + ": must be a number in [0, 10]");
  return value;
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

/** A bar on a terminal, nothing elsewhere. */
void showProgress(double share)
{
  if (!isatty(STDERR_FILENO)) return;
  std::cerr << "\r" << mrpt::system::progress(share, 40) << (share >= 1 ? "\n" : "") << std::flush;
}

void report(const std::string& file, const simulator::SimulationSummary& summary)
{
  std::cout << file << ": " << summary.frames << " frames, " << summary.boxes << " boxes of "
            << summary.truth.size() << " objects\n";
  for (const auto& object : summary.truth)
    if (object.framesVisible.value_or(0) == 0)
      std::cout << "note: object " << object.id << " (" << object.label << ") is never seen\n";
}

void run(Cli& cli)
{
  const auto seed = wholeNumber("--seed", cli.seed.getValue(), 0, 999999999999999999ULL);
  const double noise = noiseFactor(cli.noise.getValue());
  simulator::Scene scene = simulator::readScene(simulator::findScene(cli.scene.getValue()));
  if (cli.frames.isSet())
    scene.options.trajectory.frames =
        static_cast<int>(wholeNumber("--frames", cli.frames.getValue(), 2, 100000));
  if (cli.resolution.isSet()) setResolution(cli.resolution.getValue(), scene.options);
  if (cli.detections.isSet())
    scene.options.detector.output = detectorOutput(cli.detections.getValue());
  if (cli.instanceIds.isSet()) scene.options.detector.instanceIds = true;
  scene.options.scaleNoise(noise);

  const simulator::Simulator simulator(std::move(scene), LabelTable::installed(), seed);
  const std::string& output = cli.output.getValue();
  report(output, simulator::simulateToFiles(simulator, output, showProgress));
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
