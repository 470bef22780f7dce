#include <mrpt/core/format.h>

#include <cstdio>
#include <iostream>

#include "../common/CommandLine.h"
#include "../common/KeptFiles.h"
#include "../common/OtherFile.h"
#include "../common/ProgressBar.h"
#include "../common/SeveralOutputs.h"
#include "DetectRun.h"
#include "quadmap/detection/KnownDetectors.h"
#include "quadmap/sensors/RawlogNames.h"

namespace
{
using namespace quadmap;

/** Does the command line ask for the models alone? The arguments that a run requires are then not
 * needed. */
bool asksForList(int argc, char** argv) { return argc == 2 && argv[1] == std::string("--list"); }

/** The arguments of the program. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-detect",
      "Looks for objects in the colour images of an RGB-D rawlog with a neural network, and writes "
      "their boxes beside it, where quadmap-slam finds them. An earlier file of that name is "
      "replaced when all images are through; Ctrl-C ends the program and leaves it as it was.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> rawlog{
      "rawlog", "The recording, in either format of MRPT.", true, "", "IN.rawlog", line.args()};
  cli::Example knowing{line, "quadmap-detect --list", "Lists the models that are known."};
  cli::Example finding{
      line, "quadmap-detect kitchen.rawlog --model nanodet-m", "Writes kitchen.objects.rawlog."};
  cli::Group modelGroup{line, "Model"};
  Text model{
      "",
      "model",
      "Name of a model (see --list), or a model file: an INI file with the section [detector], in "
      "which weights names the network (.onnx, or .weights of Darknet with network = its "
      ".cfg), labels a file with the names of the classes, one a line, and width and height "
      "tell the size of the network's input [px].",
      true,
      "",
      "NAME|FILE",
      line.args()};
  TCLAP::SwitchArg list{
      "", "list",
      "Given alone: print the models that are known, which of them are installed, and how to get "
      "the others.",
      line.args()};
  cli::Group outputGroup{line, "Output"};
  Text output{"o",          "output",   "The boxes (default IN.objects.rawlog).", false, "",
              "OUT.rawlog", line.args()};
  Text draw{
      "",
      "draw",
      "Folder for a picture of each image with its boxes, in the place of earlier ones; made when "
      "missing.",
      false,
      "",
      "DIR",
      line.args()};
  cli::Group inputGroup{line, "Input"};
  Text sensor{"", "sensor", "Use only this RGB-D sensor.", false, "", "LABEL", line.args()};
  TCLAP::SwitchArg imagesAnywhere{
      "", "images-anywhere", "Read images that lie outside the rawlog's own image folder.",
      line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Leave out broken records and say so, instead of failing.", line.args()};
};

void printModels()
{
  std::printf("models are looked for in %s\n", detectorFolder().c_str());
  for (const auto& model : knownDetectors())
  {
    const char* state = !model.problem.empty() ? "wrong" : model.installed ? "installed" : "-";
    std::printf("%-20s  %-9s  %s\n", model.name.c_str(), state, model.licence.c_str());
    for (const std::string* line : {&model.problem, &model.howToGet})
      if (!line->empty()) std::printf("    %s\n", line->c_str());
  }
}

void run(Cli& cli)
{
  if (cli.list.isSet()) throw cli::UsageError("--list: must be given alone");
  DetectRequest request;
  request.rawlog = cli.rawlog.getValue();
  request.output = cli.output.isSet() ? cli.output.getValue() : objectsFileOf(request.rawlog);
  cli::requireOtherFile(request.output, request.rawlog);
  cli::KeptFiles kept;
  kept.add(cli.model.getValue());
  kept.requireNone("-o", request.output);
  request.pictures = cli.draw.getValue();
  request.sensorLabel = cli.sensor.getValue();
  request.keepGoing = cli.keepGoing.getValue();
  request.imagesAnywhere = cli.imagesAnywhere.getValue();
  request.onWarning = [](const std::string& text)
  { std::cerr << "quadmap-detect: warning: " << oneLine(text) << "\n"; };
  cli::ProgressBar bar;
  request.onProgress = [&bar](double share, double framesPerSecond)
  { bar(share, mrpt::format(" %.1f frames/s", framesPerSecond)); };

  std::ostream& messages = cli::messagesBeside(request.output);
  const auto detector = loadDetector(cli.model.getValue());
  if (cli.line.verbosity() <= mrpt::system::LVL_INFO)
    messages << detector->description() << std::endl;
  const DetectSummary summary = detectInRawlog(request, *detector);
  for (const auto& what : summary.dropped)
    std::cerr << "quadmap-detect: left out: " << what << "\n";
  if (summary.framesWithoutColour > 0)
    std::cerr << mrpt::format(
        "quadmap-detect: warning: %zu of %zu images have no colour: they have no boxes\n",
        summary.framesWithoutColour, summary.frames);
  messages << mrpt::format(
      "%s: %zu frames, %zu boxes, %.1f frames/s\n", request.output.c_str(), summary.frames,
      summary.boxes, summary.framesPerSecond);
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-detect",
      [&]
      {
        if (asksForList(argc, argv)) return printModels();
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
