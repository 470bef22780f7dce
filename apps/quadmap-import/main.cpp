#include <filesystem>
#include <iostream>

#include "../common/CommandLine.h"
#include "../common/KeptFiles.h"
#include "../common/OtherFile.h"
#include "../common/ProgressBar.h"
#include "../common/SeveralOutputs.h"
#include "CameraImport.h"
#include "FolderSummary.h"
#include "ImportCli.h"
#include "ImportMessages.h"
#include "RawlogImport.h"
#include "WorldUp.h"
#include "quadmap/folders/FolderCheck.h"
#include "quadmap/folders/FolderKinds.h"

namespace
{
using namespace quadmap;

RawlogWriter writerOf(ImportCli& cli)
{
  RawlogWriterOptions writing;
  writing.external = cli.external.getValue();
  return RawlogWriter(cli.output.getValue(), writing);
}

/** Where to tell what was written. */
std::ostream& messagesOf(ImportCli& cli) { return cli::messagesBeside(cli.output.getValue()); }

void import(const FrameFolder& folder, ImportCli& cli)
{
  FolderImportOptions options;
  options.posesAs = posesAs(cli.posesAs.getValue());
  options.every = static_cast<std::size_t>(cli.every.getValue());
  options.keepGoing = cli.keepGoing.getValue();
  std::ostream& messages = messagesOf(cli);
  RawlogWriter writer = writerOf(cli);
  reportBoxesOfOtherImages(folder, options.keepGoing);
  const auto report = importFolder(folder, options, writer, cli::ProgressBar());
  tellDropped(report);
  if (report.frames == 0)
    throw std::runtime_error(folder.folder() + ": no frame could be imported");
  reportUnpaired(folder);
  reportMissingDetections(report, options.keepGoing);
  reportCrowdedImages(report);
  if (options.posesAs != PosesAs::None && !folder.poses().empty())
    reportMissingPoses(folder.poses(), report);
  writer.finish();
  tellWritten(report, cli.output.getValue(), cli.posesAs.getValue(), messages);
}

/** The kind rawlog. */
int importFromRawlog(ImportCli& cli)
{
  if (cli.detections.isSet() || cli.labels.isSet() || cli.cameraName.isSet())
    throw cli::UsageError(
        "--detections, --labels, --camera: not for a rawlog, whose boxes are in "
        "NAME.objects.rawlog and whose cameras are in its records");
  if (cli.trajectory.isSet() && posesAs(cli.posesAs.getValue()) == PosesAs::None)
    throw cli::UsageError("--trajectory: has the poses that --poses-as none leaves out");
  const std::string& rawlog = cli.source.getValue();
  if (cli.check.getValue())
    return checkRawlog(rawlog, cli.imagesAnywhere.getValue(), std::cout, cli::ProgressBar()) ? 0
                                                                                             : 1;
  RawlogImportOptions options;
  options.posesAs = posesAs(cli.posesAs.getValue());
  options.trajectory = cli.trajectory.getValue();
  options.every = static_cast<std::size_t>(cli.every.getValue());
  options.keepGoing = cli.keepGoing.getValue();
  options.imagesAnywhere = cli.imagesAnywhere.getValue();
  std::ostream& messages = messagesOf(cli);
  RawlogWriter writer = writerOf(cli);
  const auto report = importRawlog(rawlog, options, writer, cli::ProgressBar());
  tellDropped(report);
  tellNotes(report.notes);
  // A rawlog may have no poses at all, as a folder, but a trajectory is given for the sake of them.
  const bool hasPoses = report.poses > 0 || report.hasOdometry || cli.trajectory.isSet();
  if (options.posesAs != PosesAs::None && hasPoses)
    reportMissingPoses(cli.trajectory.isSet() ? options.trajectory : rawlog, report);
  writer.finish();
  tellWritten(report, cli.output.getValue(), cli.posesAs.getValue(), messages);
  return 0;
}

/** Prints what a recording has and what is wrong with it.
 *  \param up Where up is.
 *  \return The exit status, 1 for problems.
 */
int checkOnly(const FrameFolder& folder, const std::string& up, ImportCli& cli)
{
  FolderCheckOptions options;
  options.maxGap = cli.maxGap.getValue();
  options.maxSpeed = cli.maxSpeed.getValue();
  const auto problems = checkFolder(folder, options, cli::ProgressBar());
  writeSummary(folder, up, std::cout);
  writeProblems(problems, std::cout);
  return problems.empty() ? 0 : 1;
}

/** The kind openni2. */
int importFromCamera(ImportCli& cli)
{
  if (cli.check.isSet() || cli.detections.isSet() || cli.labels.isSet() || cli.posesAs.isSet() ||
      cli.imagesAnywhere.isSet())
    throw cli::UsageError(
        "--check, --detections, --labels, --poses-as, --images-anywhere: not for a camera");
  CameraImportRequest request;
  request.source = cli.source.getValue();
  request.output = cli.output.getValue();
  request.camera = cli.camera.options(cli.cameraName);
  request.writing.external = cli.external.getValue();
  request.every = static_cast<std::size_t>(cli.every.getValue());
  return importCamera(request);
}

/** Whether a source has the name of a rawlog, which may be compressed. */
bool isRawlog(const std::string& source)
{
  std::filesystem::path name(source);
  if (name.extension() == ".gz") name.replace_extension();
  return name.extension() == ".rawlog";
}

/** \exception UsageError If the output would replace an image or a list of the folder that is read.
 * A rawlog may lie there, as no image or list is one. */
void requireNoFileOfFolder(const std::string& output, const std::string& source)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (isRawlog(output) || !fs::is_directory(source, ignored) || !fs::exists(output, ignored))
    return;
  const fs::path folder = fs::canonical(output, ignored).parent_path();
  if (fs::equivalent(folder, source, ignored))
    throw cli::UsageError("-o: " + output + " is a file of the recording, which stays as it is");
}

/** \exception UsageError For an output that would replace what is read. */
void checkOutput(ImportCli& cli)
{
  const std::string& output = cli.output.getValue();
  if (output.empty()) return;  // nothing is written
  cli::requireOtherRecording(output, cli.source.getValue());
  requireNoFileOfFolder(output, cli.source.getValue());
  cli::KeptFiles kept;
  for (auto* input : {&cli.trajectory, &cli.labels, &cli.cameraName, &cli.detections})
    if (input->isSet()) kept.add(input->getValue());
  for (const std::string& file : {output, objectsFileOf(output)}) kept.requireNone("-o", file);
}

int run(ImportCli& cli)
{
  const bool checking = cli.check.getValue();
  if (cli.every.getValue() < 1) throw cli::UsageError("--every: must be >= 1");
  if (!(cli.maxGap.getValue() >= 0)) throw cli::UsageError("--max-gap: must be >= 0 s");
  if (!(cli.maxSpeed.getValue() > 0)) throw cli::UsageError("--max-speed: must be > 0 m/s");
  if (!checking && cli.output.getValue().empty())
    throw cli::UsageError("missing argument: -o OUT.rawlog");
  checkOutput(cli);
  std::string kind = cli.kind.getValue();
  if (kind == kAuto && isRawlog(cli.source.getValue())) kind = kRawlog;
  if (kind != kRawlog && cli.trajectory.isSet())
    throw cli::UsageError("--trajectory: for a rawlog only");
  if (kind == kOpenNi2) return importFromCamera(cli);
  cli.camera.requireNone();
  const std::string& source = cli.source.getValue();
  if (kind == kRawlog) return importFromRawlog(cli);
  if (kind == kAuto) kind = kindOfFolder(source);
  FrameFolderOptions reading;
  reading.detections = cli.detections.getValue();
  reading.labels = cli.labels.getValue();
  reading.camera = cli.cameraName.getValue();
  reading.imagesAnywhere = cli.imagesAnywhere.getValue();
  reading.imagesHint = "--images-anywhere";
  FrameFolder folder = openFrameFolder(kind, source, reading);
  const std::string up = turnUpright(folder);
  if (checking)
  {
    tellNotes(folder.notes());
    return checkOnly(folder, up, cli);
  }
  import(folder, cli);  // tells in one line why it fails, hence the notes come when it did not
  tellNotes(folder.notes());
  if (folder.posesCount() > 0 && !folder.camera().worldUp) tellNotes({source + ": up: " + up});
  return 0;
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-import",
      [&]
      {
        ImportCli cli;
        return cli.line.parse(argc, argv) ? run(cli) : 0;
      });
}
