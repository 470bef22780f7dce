#include <filesystem>
#include <iostream>
#include <string>

#include "ProposalPictures.h"
#include "common/CommandLine.h"
#include "common/KeptFiles.h"
#include "common/ProgressBar.h"
#include "common/SeveralOutputs.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/dense/ProposalFile.h"
#include "quadmap/dense/RoomCloud.h"

namespace
{
using namespace quadmap;

/** The arguments of the program. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-annotate",
      "Proposes true objects from the depth images of a run: the map says where the objects are, "
      "and the dense cloud how large. Writes the proposals beside OUT.json, as "
      "OUT.proposals.ini to be corrected and a folder OUT.pictures with a picture of each, and the "
      "accepted ones to OUT.json. Where OUT.proposals.ini is there already, it is read, and "
      "pictures and OUT.json are made anew from it.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> result{
      "OUTDIR", "Folder quadmap-slam wrote.", true, "", "OUTDIR", line.args()};
  cli::Example proposing{
      line, "quadmap-annotate home -o home.objects.gt.json",
      "Proposes the true objects of a room, to be corrected in home.objects.gt.proposals.ini."};
  Text output{"o",        "output", "The accepted objects, in the form of objects.json.",
              true,       "",       "OUT.json",
              line.args()};
  Text config{"c",        "config",   "Section [dense]: how points are found.", false, "",
              "FILE.ini", line.args()};
  TCLAP::SwitchArg noPictures{"", "no-pictures", "Draw nothing.", line.args()};
};

std::vector<CuboidProposal> propose(const std::string& result, const DenseOptions& options)
{
  cli::ProgressBar bar;
  const LabelTable labels = LabelTable::installed();
  std::vector<CuboidProposal> proposals;
  for (const ObjectPoints& points : findObjectPoints(
           result, readObjectsJson(result + "/objects.json"), options,
           [&](double share) { bar(share); }))
    if (const auto proposal = proposeCuboid(points, labels))
      proposals.push_back(*proposal);
    else
      std::cerr << "quadmap-annotate: warning: object " << points.record.id << " ("
                << points.record.label << "): too few points for a proposal\n";
  return proposals;
}

/** What is written, and what is said of it when it is there. */
struct Output
{
  OutputGroup files;
  std::string text;
};

/** The proposals of the file or, where there is none, new ones, which are written to it. */
std::vector<JudgedProposal> proposalsOf(
    const std::string& result, const std::string& file, const DenseOptions& options, Output& output)
{
  if (std::filesystem::exists(file))
  {
    auto read = readProposals(file);
    if (read.empty())
      throw std::runtime_error(file + ": has no proposal; remove it to have proposals made anew");
    return read;
  }
  const auto proposals = propose(result, options);
  if (proposals.empty())
    throw std::runtime_error(result + ": no object has points enough for a proposal");
  writeTextFile(output.files.add(file), proposalText(proposals));
  output.text += "wrote " + file + ": " + std::to_string(proposals.size()) + " proposals\n";
  return judged(proposals);
}

void draw(
    const std::vector<JudgedProposal>& proposals,
    const std::string& result,
    const std::string& folder,
    const DenseOptions& options,
    Output& output)
{
  std::vector<ObjectRecord> records;
  for (const JudgedProposal& proposal : proposals) records.push_back(proposal.record);
  cli::ProgressBar bar;
  const DenseCloud room = fuseRoom(result, options, [&](double share) { bar(share); });
  writeProposalPictures(records, room, options.roomCell, folder, output.files);
  output.text += "wrote " + std::to_string(records.size()) + " pictures into " + folder + "\n";
}

/** \exception UsageError For an output that would replace what is read. */
void checkOutput(Cli& cli)
{
  cli::KeptFiles kept;
  kept.add(cli.result.getValue());
  if (cli.config.isSet()) kept.add(cli.config.getValue());
  kept.requireNone("-o", cli.output.getValue());
}

void run(Cli& cli)
{
  const std::string& result = cli.result.getValue();
  const std::filesystem::path truth = cli.output.getValue();
  if (truth.extension() != ".json") throw cli::UsageError("--output: the name must end in .json");
  checkOutput(cli);
  requirePcl("quadmap-annotate");
  if (!std::filesystem::is_directory(result))
    throw std::runtime_error(result + ": is no folder that quadmap-slam wrote");
  const DenseOptions options =
      cli.config.isSet() ? readDenseOptions(cli.config.getValue()) : DenseOptions();
  const auto beside = [&](const char* extension)
  { return std::filesystem::path(truth).replace_extension(extension).string(); };

  std::ostream& messages = cli::messagesBeside(truth.string());
  Output output;
  const auto proposals = proposalsOf(result, beside(".proposals.ini"), options, output);
  if (!cli.noPictures.getValue()) draw(proposals, result, beside(".pictures"), options, output);
  std::vector<ObjectRecord> accepted;
  for (const JudgedProposal& proposal : proposals)
    if (proposal.accept) accepted.push_back(proposal.record);
  writeObjectsJson(output.files.add(truth.string()), accepted);
  output.files.commit();
  messages << output.text << "wrote " << truth.string() << ": " << accepted.size() << " of "
           << proposals.size() << " objects\n";
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-annotate",
      [&]
      {
        Cli cli;
        if (cli.line.parse(argc, argv)) run(cli);
      });
}
