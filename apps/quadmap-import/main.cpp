#include <algorithm>
#include <iostream>

#include "../common/CameraArguments.h"
#include "../common/CommandLine.h"
#include "../common/ProgressBar.h"
#include "CameraImport.h"
#include "TumImport.h"
#include "quadmap/sensors/TumCheck.h"

namespace
{
using namespace quadmap;

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "quadmap-import",
      "Turns an RGB-D recording into a rawlog that every MRPT program reads, its poses included, "
      "and the boxes of a detector into OUT.objects.rawlog beside it.",
      QUADMAP_VERSION};
  std::vector<std::string> formats{"tum", "openni2"}, poseKinds{"odometry", "ground-truth", "none"};
  TCLAP::ValuesConstraint<std::string> knownFormats{formats}, knownPoses{poseKinds};
  TCLAP::UnlabeledValueArg<std::string> format{
      "format",
      "Layout of the recording: tum (TUM RGB-D benchmark), or openni2 (a camera by OpenNI2).",
      true,
      "",
      &knownFormats,
      line.args()};
  TCLAP::UnlabeledValueArg<std::string> source{
      "SOURCE", "Folder of the recording; openni2: live, the plugged-in camera, or FILE.oni.",
      true,     "",
      "SOURCE", line.args()};
  cli::Example checking{
      line, "quadmap-import tum my_kitchen --check",
      "Says what is wrong with a recording, and writes nothing."};
  cli::Example importing{
      line, "quadmap-import tum my_kitchen -o kitchen.rawlog", "Makes a rawlog of it."};
  cli::Group outputGroup{line, "Output"};
  TCLAP::ValueArg<std::string> output{"o",          "output",   "The rawlog to write.", false, "",
                                      "OUT.rawlog", line.args()};
  cli::Group checkGroup{line, "Check"};
  TCLAP::SwitchArg check{
      "", "check", "Write nothing; list what is wrong with the recording.", line.args()};
  TCLAP::ValueArg<double> maxGap{
      "",  "max-gap",  "--check: longest time between frames [s] (default: 5 medians).", false, 0,
      "S", line.args()};
  TCLAP::ValueArg<double> maxSpeed{
      "", "max-speed", "--check: fastest plausible motion [m/s].", false, 2.0, "M/S", line.args()};
  cli::Group conversion{line, "Conversion"};
  TCLAP::SwitchArg external{
      "", "external", "Images into OUT_Images/ instead of into the rawlog.", line.args()};
  TCLAP::ValueArg<std::string> posesAs{
      "", "poses-as", "What the poses become.", false, "odometry", &knownPoses, line.args()};
  TCLAP::ValueArg<std::string> detections{
      "",    "detections", "Folder of the boxes (default SOURCE/detections).", false, "",
      "DIR", line.args()};
  TCLAP::ValueArg<int> every{"",  "every",    "Take every n-th frame only.", false, 1,
                             "N", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Drop what cannot be used, say so, and go on.", line.args()};
  cli::Group cameraGroup{line, "Camera"};
  cli::CameraArguments camera{line.args()};
};

PosesAs posesAs(const std::string& name)
{
  if (name == "odometry") return PosesAs::Odometry;
  return name == "none" ? PosesAs::None : PosesAs::GroundTruth;
}

/** Images without a file of boxes were not seen by the detector, or the files have other names.
 *  \exception std::runtime_error If no image has one, unless the import is to go on. */
void reportMissingDetections(
    const TumDataset& dataset, const TumImportReport& report, bool keepGoing)
{
  if (report.withoutDetections == 0) return;
  const std::string text = std::to_string(report.withoutDetections) + " of " +
                           std::to_string(report.frames) + " images have no file of boxes, as " +
                           dataset.boxesFile(0) + " is the one of the first";
  if (report.withoutDetections == report.frames && !keepGoing) throw std::runtime_error(text);
  std::cerr << "quadmap-import: warning: " << oneLine(text) << "\n";
}

void import(const TumDataset& dataset, Cli& cli)
{
  TumImportOptions options;
  options.posesAs = posesAs(cli.posesAs.getValue());
  options.every = static_cast<std::size_t>(cli.every.getValue());
  options.keepGoing = cli.keepGoing.getValue();
  RawlogWriterOptions writing;
  writing.external = cli.external.getValue();
  RawlogWriter writer(cli.output.getValue(), writing);
  const auto report = importTum(dataset, options, writer, cli::ProgressBar());
  for (const auto& what : report.dropped)
    std::cerr << "quadmap-import: dropped: " << oneLine(what) << "\n";
  if (report.frames == 0)
    throw std::runtime_error(dataset.folder() + ": no frame could be imported");
  reportMissingDetections(dataset, report, options.keepGoing);
  writer.finish();
  std::cout << cli.output.getValue() << ": " << report.frames << " frames, " << report.poses
            << " poses as " << cli.posesAs.getValue() << ", " << report.boxes << " boxes";
  if (!report.dropped.empty()) std::cout << " (" << report.dropped.size() << " things dropped)";
  std::cout << "\n";
}

/** Prints the problems of a recording, by kind. \return The exit status, 1 if there are any. */
int checkOnly(const TumDataset& dataset, Cli& cli)
{
  constexpr std::size_t kExamples = 3;
  TumCheckOptions options;
  options.maxGap = cli.maxGap.getValue();
  options.maxSpeed = cli.maxSpeed.getValue();
  const auto problems = checkTum(dataset, options, cli::ProgressBar());
  const auto& frames = dataset.frames();
  std::cout << dataset.folder() << ": " << frames.size() << " frames in "
            << frames.back().time - frames.front().time << " s, " << dataset.trajectory().size()
            << " poses: " << (problems.empty() ? "no problem found\n" : "\n");
  for (const auto& [kind, texts] : problems)
  {
    std::cout << kind << " (" << texts.size() << ")\n";
    for (std::size_t i = 0; i < std::min(texts.size(), kExamples); ++i)
      std::cout << "  " << oneLine(texts[i]) << "\n";
    if (texts.size() > kExamples) std::cout << "  ...\n";
  }
  return problems.empty() ? 0 : 1;
}

/** The kind openni2. */
int importFromCamera(Cli& cli)
{
  if (cli.check.isSet() || cli.detections.isSet() || cli.posesAs.isSet())
    throw cli::UsageError("--check, --detections, --poses-as: not for a camera");
  CameraImportRequest request;
  request.source = cli.source.getValue();
  request.output = cli.output.getValue();
  request.camera = cli.camera.options();
  request.writing.external = cli.external.getValue();
  request.every = static_cast<std::size_t>(cli.every.getValue());
  return importCamera(request);
}

int run(Cli& cli)
{
  const bool checking = cli.check.getValue();
  if (cli.every.getValue() < 1) throw cli::UsageError("--every: must be >= 1");
  if (!(cli.maxGap.getValue() >= 0)) throw cli::UsageError("--max-gap: must be >= 0 s");
  if (!(cli.maxSpeed.getValue() > 0)) throw cli::UsageError("--max-speed: must be > 0 m/s");
  TumDatasetOptions reading;
  reading.detections = cli.detections.getValue();
  if (!checking && cli.output.getValue().empty())
    throw cli::UsageError("missing argument: -o OUT.rawlog");
  if (cli.format.getValue() == "openni2") return importFromCamera(cli);
  cli.camera.requireNone();
  const TumDataset dataset(cli.source.getValue(), reading);
  for (const auto& note : dataset.notes())
    std::cerr << "quadmap-import: note: " << oneLine(note) << "\n";
  if (checking) return checkOnly(dataset, cli);
  import(dataset, cli);
  return 0;
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-import",
      [&]
      {
        Cli cli;
        return cli.line.parse(argc, argv) ? run(cli) : 0;
      });
}
