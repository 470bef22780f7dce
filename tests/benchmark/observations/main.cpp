#include <fstream>
#include <iostream>
#include <sstream>

#include "../../../apps/common/CommandLine.h"
#include "AblationTable.h"
#include "EdgeTable.h"
#include "EdgeWeights.h"
#include "OrientationTable.h"
#include "ResidualTable.h"
#include "quadmap/base/ConfigCheck.h"

// Tables that tell how good the measurements of single frames are, on simulated scenes with known
// truth; doc/benchmarks.md quotes them.

namespace
{
using namespace quadmap;
using namespace quadmap::observations;

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "observation_tables",
      "Measures the objects of simulated frames at their true poses and prints a table. residuals: "
      "residuals of the map's factors at the true state, in units of their sigmas; edges: how well "
      "the usable box edges are told from the others; edge-weights: the weights by which they are "
      "told, fitted anew; ablation: the map's errors with each model and rule; orientation: errors "
      "of the measured headings per class.",
      "benchmark"};
  std::vector<std::string> tables{"residuals", "edges", "edge-weights", "ablation", "orientation"};
  TCLAP::ValuesConstraint<std::string> tableConstraint{tables};
  TCLAP::UnlabeledValueArg<std::string> table{"TABLE", "What to print.", true,
                                              "",      &tableConstraint, line.args()};
  TCLAP::ValueArg<std::string> scene{
      "",
      "scene",
      "Installed scene, path of a scene file, or random: another room for each seed.",
      false,
      "home",
      "SCENE",
      line.args()};
  TCLAP::ValueArg<std::string> seeds{
      "",        "seeds",    "Of the simulations, separated by commas.", false, "1,2,3",
      "N,N,...", line.args()};
  TCLAP::ValueArg<std::string> resolution{
      "", "resolution", "Image size, same width of view.", false, "320x240", "WxH", line.args()};
  TCLAP::ValueArg<int> framesStep{"",  "frames-step", "Every n-th frame only.", false, 1,
                                  "N", line.args()};
  TCLAP::ValueArg<double> invalidBeyond{
      "",
      "invalid-beyond",
      "edges, edge-weights: one is invalid when the object's outline ends further beyond it [px of "
      "640].",
      false,
      18,
      "PX",
      line.args()};
  TCLAP::SwitchArg perLabel{
      "", "per-label", "residuals, edges: rows for each label too.", line.args()};
  TCLAP::ValueArg<std::string> json{
      "", "json", "Write the table to this file too.", false, "", "FILE", line.args()};
  TCLAP::ValueArg<std::string> raw{
      "", "raw", "residuals: write every residual here.", false, "", "FILE", line.args()};
};

int wholeNumber(const std::string& option, const std::string& text)
{
  const auto value = parseNumber(text);
  if (!value || *value != static_cast<int>(*value) || *value < 0)
    throw cli::UsageError("--" + option + ": \"" + text + "\" is not a whole number");
  return static_cast<int>(*value);
}

RunOptions runOptions(Cli& cli)
{
  RunOptions run;
  run.scene = cli.scene.getValue();
  run.seeds.clear();
  std::istringstream list(cli.seeds.getValue());
  for (std::string seed; std::getline(list, seed, ',');)
    run.seeds.push_back(static_cast<std::uint64_t>(wholeNumber("seeds", seed)));
  const std::string& size = cli.resolution.getValue();
  const auto x = size.find('x');
  if (x == std::string::npos) throw cli::UsageError("--resolution: expected WIDTHxHEIGHT");
  run.width = wholeNumber("resolution", size.substr(0, x));
  run.height = wholeNumber("resolution", size.substr(x + 1));
  if (run.width < 64 || run.height < 64) throw cli::UsageError("--resolution: at least 64x64");
  if (cli.framesStep.getValue() < 1) throw cli::UsageError("--frames-step: at least 1");
  run.framesStep = static_cast<std::size_t>(cli.framesStep.getValue());
  return run;
}

Rows printTable(Cli& cli)
{
  const RunOptions run = runOptions(cli);
  const std::string& table = cli.table.getValue();
  if (table == "edges")
    return printEdgeTable(run, {cli.invalidBeyond.getValue()}, cli.perLabel.getValue(), std::cout);
  if (table == "edge-weights")
    return printEdgeWeights(run, {cli.invalidBeyond.getValue()}, std::cout);
  if (table == "ablation") return printAblationTable(run, std::cout);
  if (table == "orientation") return printOrientationTable(run, std::cout);
  std::ofstream raw;
  if (cli.raw.isSet())
  {
    raw.open(cli.raw.getValue());
    if (!raw) throw std::runtime_error("cannot write " + cli.raw.getValue());
  }
  return printResidualTable(
      run, cli.perLabel.getValue(), std::cout, cli.raw.isSet() ? &raw : nullptr);
}

void run(Cli& cli)
{
  const Rows rows = printTable(cli);
  if (cli.json.isSet()) writeRows(cli.json.getValue(), rows);
}

}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "observation_tables",
      [&]
      {
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
