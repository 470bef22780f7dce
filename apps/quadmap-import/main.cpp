#include <filesystem>
#include <iostream>

#include "../common/CameraArguments.h"
#include "../common/CommandLine.h"
#include "../common/OtherFile.h"
#include "../common/ProgressBar.h"
#include "CameraImport.h"
#include "FloorUp.h"
#include "FolderImport.h"
#include "FolderSummary.h"
#include "RawlogImport.h"
#include "quadmap/folders/FolderCheck.h"
#include "quadmap/folders/FolderKinds.h"

namespace
{
using namespace quadmap;

constexpr const char* kOpenNi2 = "openni2";
constexpr const char* kRawlog = "rawlog";
constexpr const char* kAuto = "auto";

/** All kinds of sources. */
std::vector<std::string> sourceKinds()
{
  auto kinds = folderKinds();
  kinds.emplace_back(kRawlog);
  kinds.emplace_back(kOpenNi2);
  kinds.emplace_back(kAuto);
  return kinds;
}

/** The arguments of the program. */
struct Cli
{
  cli::CommandLine line{
      "quadmap-import",
      "Turns an RGB-D recording into a rawlog that every MRPT program reads, its poses included, "
      "and the boxes of a detector into OUT.objects.rawlog beside it.",
      QUADMAP_VERSION};
  std::vector<std::string> kinds = sourceKinds(), poseKinds{"odometry", "ground-truth", "none"};
  TCLAP::ValuesConstraint<std::string> knownKinds{kinds}, knownPoses{poseKinds};
  TCLAP::UnlabeledValueArg<std::string> kind{
      "kind",
      "What the recording is: a folder as downloaded from, or in the layout of, TUM RGB-D (tum), "
      "ICL-NUIM (icl), 7-Scenes (7scenes) or ScanNet (scannet), or with organised clouds of PCL "
      "(pcd); a rawlog of one or several sensors, as those of Robot@Home (rawlog); a camera by "
      "OpenNI2 (openni2); or auto, which tells the kind of a folder by its files.",
      true,
      "",
      &knownKinds,
      line.args()};
  TCLAP::UnlabeledValueArg<std::string> source{
      "SOURCE",
      "Folder of the recording, or a rawlog; openni2: live, the plugged-in camera, or FILE.oni.",
      true,
      "",
      "SOURCE",
      line.args()};
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
  TCLAP::ValueArg<std::string> trajectory{
      "",
      "trajectory",
      "rawlog: poses of the robot, as quadmap-slam writes them, instead of the rawlog's odometry.",
      false,
      "",
      "FILE.tum",
      line.args()};
  TCLAP::ValueArg<std::string> detections{
      "",
      "detections",
      "Boxes: a folder of text files, one per image, in the form of quadmap or of YOLO's save_txt, "
      "or a JSON file in COCO's form (default SOURCE/detections).",
      false,
      "",
      "DIR|FILE.json",
      line.args()};
  TCLAP::ValueArg<std::string> labels{
      "",
      "labels",
      "Names of the classes, one a line, for boxes that have numbers (default: a file beside them, "
      "or COCO's).",
      false,
      "",
      "FILE",
      line.args()};
  TCLAP::ValueArg<std::string> cameraName{
      "",
      "camera",
      "The camera, when the recording or the device does not tell: a name of share/quadmap/cameras "
      "or a file.",
      false,
      "",
      "NAME|FILE",
      line.args()};
  TCLAP::ValueArg<int> every{"",  "every",    "Take every n-th frame only.", false, 1,
                             "N", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Drop what cannot be used, say so, and go on.", line.args()};
  TCLAP::SwitchArg imagesAnywhere{
      "", "images-anywhere", "Read images that lie outside the recording's own folder.",
      line.args()};
  cli::Group cameraGroup{line, "Camera"};
  cli::CameraArguments camera{line.args()};
};

PosesAs posesAs(const std::string& name)
{
  if (name == "odometry") return PosesAs::Odometry;
  return name == "none" ? PosesAs::None : PosesAs::GroundTruth;
}

/** Boxes of no image at all have the names of other images.
 *  \exception std::runtime_error If it is so, unless the import is to go on. */
void reportBoxesOfOtherImages(const FrameFolder& folder, bool keepGoing)
{
  if (!folder.boxesAreOfOtherImages()) return;
  const std::string text = folder.detections() + ": none of its boxes is of an image of " +
                           folder.folder() + ", as the names or numbers of the images differ";
  if (!keepGoing) throw std::runtime_error(text);
  std::cerr << "quadmap-import: warning: " << oneLine(text) << "\n";
}

/** Images without a file of boxes were not seen by the detector, or the files have other names.
 *  \exception std::runtime_error If no image has one, unless the import is to go on. */
void reportMissingDetections(const FolderImportReport& report, bool keepGoing)
{
  if (report.withoutDetections == 0) return;
  const std::string text = std::to_string(report.withoutDetections) + " of " +
                           std::to_string(report.frames) +
                           " images have no result of the detector; that of the first would be " +
                           report.firstWithoutDetections;
  if (report.withoutDetections == report.frames && !keepGoing) throw std::runtime_error(text);
  std::cerr << "quadmap-import: warning: " << oneLine(text) << "\n";
}

/** Frames without a pose are mapped only where the poses around them are known.
 *  \param poses Where the poses are from. */
void reportMissingPoses(const std::string& poses, const FolderImportReport& report)
{
  if (report.poses < report.frames)
    std::cerr << "quadmap-import: warning: " << report.frames - report.poses << " of "
              << report.frames << " frames have no pose in " << oneLine(poses) << "\n";
}

RawlogWriter writerOf(Cli& cli)
{
  RawlogWriterOptions writing;
  writing.external = cli.external.getValue();
  return RawlogWriter(cli.output.getValue(), writing);
}

void tellDropped(const FolderImportReport& report)
{
  for (const auto& what : report.dropped)
    std::cerr << "quadmap-import: dropped: " << oneLine(what) << "\n";
}

void tellNotes(const std::vector<std::string>& notes)
{
  for (const auto& note : notes) std::cerr << "quadmap-import: note: " << oneLine(note) << "\n";
}

void tellWritten(const FolderImportReport& report, Cli& cli)
{
  std::cout << cli.output.getValue() << ": " << report.frames << " frames, " << report.poses
            << " poses as " << cli.posesAs.getValue() << ", " << report.boxes << " boxes";
  if (!report.dropped.empty()) std::cout << " (" << report.dropped.size() << " things dropped)";
  std::cout << "\n";
}

void import(const FrameFolder& folder, Cli& cli)
{
  FolderImportOptions options;
  options.posesAs = posesAs(cli.posesAs.getValue());
  options.every = static_cast<std::size_t>(cli.every.getValue());
  options.keepGoing = cli.keepGoing.getValue();
  RawlogWriter writer = writerOf(cli);
  reportBoxesOfOtherImages(folder, options.keepGoing);
  const auto report = importFolder(folder, options, writer, cli::ProgressBar());
  tellDropped(report);
  if (report.frames == 0)
    throw std::runtime_error(folder.folder() + ": no frame could be imported");
  reportMissingDetections(report, options.keepGoing);
  if (options.posesAs != PosesAs::None && !folder.poses().empty())
    reportMissingPoses(folder.poses(), report);
  writer.finish();
  tellWritten(report, cli);
}

/** The kind rawlog. */
int importFromRawlog(Cli& cli)
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
  RawlogWriter writer = writerOf(cli);
  const auto report = importRawlog(rawlog, options, writer, cli::ProgressBar());
  tellDropped(report);
  // A rawlog may have no poses at all, as a folder, but a trajectory is given for the sake of them.
  const bool hasPoses = report.poses > 0 || report.hasOdometry || cli.trajectory.isSet();
  if (options.posesAs != PosesAs::None && hasPoses)
    reportMissingPoses(cli.trajectory.isSet() ? options.trajectory : rawlog, report);
  writer.finish();
  tellWritten(report, cli);
  return 0;
}

/** Prints what a recording has and what is wrong with it.
 *  \param up Where up is.
 *  \return The exit status, 1 for problems.
 */
int checkOnly(const FrameFolder& folder, const std::string& up, Cli& cli)
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
int importFromCamera(Cli& cli)
{
  if (cli.check.isSet() || cli.detections.isSet() || cli.labels.isSet() || cli.posesAs.isSet())
    throw cli::UsageError("--check, --detections, --labels, --poses-as: not for a camera");
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

int run(Cli& cli)
{
  const bool checking = cli.check.getValue();
  if (cli.every.getValue() < 1) throw cli::UsageError("--every: must be >= 1");
  if (!(cli.maxGap.getValue() >= 0)) throw cli::UsageError("--max-gap: must be >= 0 s");
  if (!(cli.maxSpeed.getValue() > 0)) throw cli::UsageError("--max-speed: must be > 0 m/s");
  if (!checking && cli.output.getValue().empty())
    throw cli::UsageError("missing argument: -o OUT.rawlog");
  cli::requireOtherFile(cli.output.getValue(), cli.source.getValue());
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
        Cli cli;
        return cli.line.parse(argc, argv) ? run(cli) : 0;
      });
}
