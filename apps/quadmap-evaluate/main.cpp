#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/CommandLine.h"
#include "common/KeptFiles.h"
#include "common/ProgressBar.h"
#include "common/SeveralOutputs.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/dense/DenseCloud.h"
#include "quadmap/dense/DepthCheck.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/review/ReportPage.h"

namespace
{
using namespace quadmap;

/** The arguments of the program. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-evaluate",
      "Compares what quadmap-slam wrote with the truth: ATE of the trajectory; position, "
      "orientation, shape and overlap of the objects; precision, recall and F1. At least one of "
      "--objects, --trajectory and --self is needed. A trajectory alone (EST.tum) is compared as "
      "evo_ape --align does; a map alone in place.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> estimate{
      "OUTDIR",
      "Folder quadmap-slam wrote, a file of a map (.quadmap, .simplemap or .json), or the file of "
      "a trajectory: time tx ty tz qx qy qz qw.",
      true,
      "",
      "OUTDIR|MAP|EST.tum",
      line.args()};
  cli::Example comparing{
      line,
      "quadmap-evaluate home --objects home.objects.gt.json --trajectory home.groundtruth.tum "
      "--json home.json",
      "Compares a map with its truth, as a table and as JSON."};
  cli::Group truth{line, "Truth"};
  Text objects{"",         "objects", "True objects, same form as objects.json.",
               false,      "",        "objects.gt.json",
               line.args()};
  Text trajectory{"",         "trajectory", "True trajectory: time tx ty tz qx qy qz qw.",
                  false,      "",           "groundtruth.tum",
                  line.args()};
  cli::Group comparison{line, "Comparison"};
  Text json{"", "json", "Write the figures to this file too.", false, "", "FILE", line.args()};
  Text html{
      "",
      "html",
      "Write the report of the run with the figures as a page, too (of OUTDIR); needs "
      "--objects or --trajectory.",
      false,
      "",
      "FILE",
      line.args()};
  TCLAP::SwitchArg inPlace{
      "", "in-place", "Both worlds are the same: compare without aligning them.", line.args()};
  TCLAP::SwitchArg self{
      "", "self",
      "How well the objects of OUTDIR explain the depth images they were made of; needs no truth.",
      line.args()};
  Text config{"c",        "config",   "Section [dense]: how --self finds the points.", false, "",
              "FILE.ini", line.args()};
  TCLAP::ValueArg<double> maxTimeDifference{
      "",
      "max-time-difference",
      "Between an estimated and a true pose [s] (default 0.02; 0.01 for EST.tum).",
      false,
      kMaxTimeDifference,
      "S",
      line.args()};
};

/** The value of an argument, if it was given. */
std::optional<std::string> given(Cli::Text& argument)
{
  if (!argument.isSet()) return std::nullopt;
  return argument.getValue();
}

/** The objects of the estimate when it is the file of a map. */
std::optional<std::vector<ObjectRecord>> mapObjectsOf(const std::string& estimate)
{
  const std::filesystem::path path = estimate;
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  if (path.extension() == ".json") return readObjectsJson(estimate);
  if (path.extension() == ".quadmap" || path.extension() == ".simplemap")
    return readMap(estimate).toRecords();
  return std::nullopt;
}

/** Writes the page to a file that gets its name later. */
void writeReport(Cli& cli, const EvaluationReport& figures, const std::string& file)
{
  ReportTruth truth;
  truth.figures = figures;
  truth.inPlace = cli.inPlace.getValue();
  truth.maxTimeDifference = cli.maxTimeDifference.getValue();
  if (cli.trajectory.isSet()) truth.trajectory = readTumTrajectory(cli.trajectory.getValue());
  if (figures.reflection && truth.trajectory)
    for (StampedPose& stamped : *truth.trajectory)
      stamped.pose = (*figures.reflection)(stamped.pose);
  writeTextFile(file, reportPage(cli.estimate.getValue(), truth));
}

SelfCheck selfCheck(const std::string& result, const std::optional<std::string>& config)
{
  if (!std::filesystem::is_directory(result))
    throw std::runtime_error(result + ": --self needs a folder that quadmap-slam wrote");
  const DenseOptions options = config ? readDenseOptions(*config) : DenseOptions();
  cli::ProgressBar bar;
  return checkAgainstDepth(
      result, readObjectsJson(result + "/objects.json"), options,
      [&](double share) { bar(share); });
}

/** The files that were asked for. */
cli::NamedOutputs outputsOf(Cli& cli)
{
  cli::NamedOutputs outputs;
  for (Cli::Text* output : {&cli.json, &cli.html})
    if (output->isSet()) outputs.emplace_back("--" + output->getName(), output->getValue());
  return outputs;
}

/** \exception UsageError For an output that would replace what is read, would be taken for it, or
 * is another output, too. */
void checkOutputs(Cli& cli)
{
  cli::KeptFiles kept;
  kept.add(cli.estimate.getValue(), "report.html");  // to be written anew with the figures
  for (Cli::Text* input : {&cli.objects, &cli.trajectory, &cli.config})
    if (input->isSet()) kept.add(input->getValue(), "report.html");
  for (const auto& [output, ending] : {
           std::pair(&cli.json, ".json"), {&cli.html, ".html"}
  })
    if (output->isSet()) cli::requireNoOtherEnding(output->getName(), output->getValue(), ending);
  const cli::NamedOutputs outputs = outputsOf(cli);
  for (const auto& [option, output] : outputs) kept.requireNone(option, output);
  cli::requireDifferentFiles(outputs);
}

/** \exception UsageError For arguments that do not go together. */
void checkUsage(Cli& cli)
{
  const bool hasTruth = cli.objects.isSet() || cli.trajectory.isSet();
  if (!hasTruth && !cli.self.getValue())
    throw cli::UsageError(
        "nothing to compare with: give --objects, --trajectory, --self or several");
  if (cli.html.isSet() && !hasTruth)
    throw cli::UsageError("--html: needs --objects or --trajectory");
  if (cli.config.isSet() && !cli.self.getValue())
    throw cli::UsageError("--config: belongs to --self");
  if (!(cli.maxTimeDifference.getValue() >= 0))
    throw cli::UsageError("--max-time-difference: must be >= 0");
  if (cli.html.isSet() && std::filesystem::is_regular_file(cli.estimate.getValue()))
    throw cli::UsageError("--html: needs a folder that quadmap-slam wrote");
  checkOutputs(cli);
}

void run(Cli& cli)
{
  checkUsage(cli);
  const bool hasTruth = cli.objects.isSet() || cli.trajectory.isSet();
  EvaluationInput input;
  input.estimate = cli.estimate.getValue();
  input.mapObjects = mapObjectsOf(input.estimate);
  input.trueObjectsPath = given(cli.objects);
  input.trueTrajectoryPath = given(cli.trajectory);
  input.inPlace = cli.inPlace.getValue();
  if (cli.maxTimeDifference.isSet()) input.maxTimeDifference = cli.maxTimeDifference.getValue();
  if (cli.self.getValue()) requirePcl("--self");
  EvaluationReport report = hasTruth ? evaluateRun(input) : EvaluationReport();
  if (cli.self.getValue()) report.self = selfCheck(input.estimate, given(cli.config));

  if (cli.line.verbosity() == mrpt::system::LVL_DEBUG)
    std::cerr << "quadmap-evaluate: pose of the map in the true world (x y z yaw pitch roll): "
              << report.T_truth_estimated << "\n";
  cli::messagesBeside(outputsOf(cli)) << toTable(report);
  OutputGroup files;
  if (cli.json.isSet()) writeTextFile(files.add(cli.json.getValue()), toJson(report));
  if (cli.html.isSet()) writeReport(cli, report, files.add(cli.html.getValue()));
  files.commit();
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-evaluate",
      [&]
      {
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
