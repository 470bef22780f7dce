#include "RawlogImport.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "FolderSummary.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
namespace
{
RawlogSourceOptions readingOptions(const std::string& rawlog, bool keepGoing, bool imagesAnywhere)
{
  RawlogSourceOptions options;
  options.imagesAnywhere = imagesAnywhere;
  options.imagesHint = "--images-anywhere";
  options.odometryKind = bestOdometryKind(rawlog, options);
  options.pixelLabelClasses = LabelTable::installed();
  options.keepGoing = keepGoing;
  return options;
}

/** What a rawlog has of one RGB-D sensor. */
struct SensorContent
{
  mrpt::img::TCamera camera;
  mrpt::poses::CPose3D T_robot_sensor;
  std::size_t frames = 0, withOdometry = 0, withTruth = 0, withBoxes = 0, boxes = 0;
  std::size_t withoutColor = 0, withoutDepth = 0;
};

/** What a rawlog has. */
struct RawlogContent
{
  std::map<std::string, SensorContent> sensors;
  std::string odometryKind;    //!< Empty when it has no odometry, be it of use or not
  double first = 0, last = 0;  //!< Times [s]
  std::size_t frames = 0;
  bool boxesOfPixels = false;

  void add(const RgbdFrame& frame)
  {
    const auto& scan = *frame.scan;
    if (frames++ == 0) first = last = frame.time();
    first = std::min(first, frame.time());
    last = std::max(last, frame.time());
    auto& sensor = sensors[scan.sensorLabel];
    sensor.camera = scan.cameraParams;
    sensor.T_robot_sensor = scan.sensorPose;
    ++sensor.frames;
    sensor.withOdometry += frame.T_odom_robot ? 1 : 0;
    sensor.withTruth += frame.T_world_robot ? 1 : 0;
    sensor.withBoxes += frame.objects ? 1 : 0;
    sensor.boxes += frame.objects ? frame.objects->objects.size() : 0;
    sensor.withoutColor += scan.hasIntensityImage ? 0 : 1;
    sensor.withoutDepth += scan.hasRangeImage && scan.rangeImage.asEigen().any() ? 0 : 1;
    boxesOfPixels = boxesOfPixels || frame.objectsFromPixelLabels;
  }

  std::size_t sum(std::size_t SensorContent::*member) const
  {
    std::size_t sum = 0;
    for (const auto& one : sensors) sum += one.second.*member;
    return sum;
  }
};

std::string sensorText(const std::string& label, const SensorContent& sensor)
{
  const auto& c = sensor.camera;
  const auto& T = sensor.T_robot_sensor;
  return mrpt::format(
      "  %s: %zu frames, %ux%u, fx %g, fy %g, cx %g, cy %g, on the robot at (%.3f, %.3f, %.3f) m, "
      "yaw %.1f, pitch %.1f, roll %.1f deg\n",
      oneLine(label).c_str(), sensor.frames, c.ncols, c.nrows, c.fx(), c.fy(), c.cx(), c.cy(),
      T.x(), T.y(), T.z(), mrpt::RAD2DEG(T.yaw()), mrpt::RAD2DEG(T.pitch()),
      mrpt::RAD2DEG(T.roll()));
}

std::string posesText(const RawlogContent& content)
{
  const std::size_t odometry = content.sum(&SensorContent::withOdometry),
                    truth = content.sum(&SensorContent::withTruth);
  std::string text = "  poses: ";
  if (content.odometryKind.empty())
    text += "no odometry, so that quadmap-slam takes them from the images of one sensor";
  else
    text += mrpt::format("odometry for %zu frames (%s)", odometry, content.odometryKind.c_str());
  if (truth > 0) text += mrpt::format("; true ones for %zu frames", truth);
  return text + "\n";
}

std::string boxesText(const RawlogContent& content)
{
  const std::size_t with = content.sum(&SensorContent::withBoxes);
  if (with == 0) return "  detections: none\n";
  return mrpt::format(
      "  detections: %zu boxes in %zu frames%s\n", content.sum(&SensorContent::boxes), with,
      content.boxesOfPixels ? ", of labels of pixels" : "");
}

void addProblems(const RawlogContent& content, FolderProblems& problems)
{
  const auto add = [&](const char* kind, const std::string& label, std::size_t count)
  {
    if (count > 0) problems[kind].push_back(mrpt::format("%s: %zu frames", label.c_str(), count));
  };
  for (const auto& [label, sensor] : content.sensors)
  {
    add("no colour", label, sensor.withoutColor);
    add("no depth", label, sensor.withoutDepth);
    if (!content.odometryKind.empty()) add("no pose", label, sensor.frames - sensor.withOdometry);
  }
}

/** The odometry of a frame, which a trajectory replaces. */
std::optional<mrpt::poses::CPose3D> odometryOf(
    const RgbdFrame& frame, const std::optional<Trajectory>& trajectory)
{
  constexpr double kLongestGap = 1.0;  // to interpolate poses over [s], as in a rawlog
  return trajectory ? poseAt(*trajectory, frame.time(), kLongestGap) : frame.T_odom_robot;
}

/** The poses of a file, whose unusable lines go into `dropped`. Those of a file with too many of
 * them are left out, as are those of a folder.
 * \exception std::runtime_error If the file cannot be read, or for the first unusable line unless
 * `keepGoing`. */
Trajectory readPoses(const std::string& file, bool keepGoing, std::vector<std::string>& dropped)
{
  Trajectory poses;
  try
  {
    poses = readTrajectoryInOrder(file, dropped);
  }
  catch (const std::runtime_error& e)
  {
    if (dropped.empty() || !keepGoing) throw;
    dropped = {e.what()};
  }
  if (!dropped.empty() && !keepGoing) throw std::runtime_error(dropped.front());
  return poses;
}

void writeFrame(
    const RgbdFrame& frame,
    const std::optional<mrpt::poses::CPose3D>& T_odom_robot,
    const RawlogImportOptions& options,
    RawlogWriter& writer,
    FolderImportReport& report)
{
  const auto time = frame.scan->timestamp;
  if (frame.T_world_robot) writer.writePose(time, kGroundTruthLabel, *frame.T_world_robot);
  const bool isOdometry = options.posesAs == PosesAs::Odometry;
  const bool hasTruth = options.posesAs == PosesAs::GroundTruth && frame.T_world_robot;
  if (T_odom_robot && !hasTruth && options.posesAs != PosesAs::None)
    writer.writePose(time, isOdometry ? kOdometryLabel : kGroundTruthLabel, *T_odom_robot);
  if (hasTruth || (T_odom_robot && options.posesAs != PosesAs::None)) ++report.poses;
  writer.write(*frame.scan);
  ++report.frames;
  if (!frame.objects) return;
  writer.write(*frame.objects);
  report.boxes += frame.objects->objects.size();
}
}  // namespace

FolderImportReport importRawlog(
    const std::string& rawlog,
    const RawlogImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress)
{
  RawlogSource source(rawlog, readingOptions(rawlog, options.keepGoing, options.imagesAnywhere));
  FolderImportReport report;
  std::optional<Trajectory> trajectory;
  if (!options.trajectory.empty())
  {
    trajectory = readPoses(options.trajectory, options.keepGoing, report.dropped);
    if (const auto warning = warningOfCut(options.trajectory); !warning.empty())
      report.notes.push_back(options.trajectory + ": " + warning);
  }
  source.sendWarningsTo([&](const std::string& text) { report.notes.push_back(text); });
  std::map<std::string, std::size_t> seen;  // frames of each sensor
  bool trajectoryFits = false;
  while (const auto frame = source.next())
  {
    progress(source.progress());
    if (seen[frame->scan->sensorLabel]++ % options.every != 0) continue;
    const auto odometry = odometryOf(*frame, trajectory);
    trajectoryFits = trajectoryFits || (trajectory && odometry);
    writeFrame(*frame, odometry, options, writer, report);
  }
  progress(1.0);
  report.hasOdometry = !source.odometryKind().empty();
  for (const auto& problem : source.problems()) report.dropped.push_back(problem.text());
  if (report.frames == 0) throw std::runtime_error(rawlog + ": " + source.whyNoFrames());
  if (trajectory && !trajectoryFits && !options.keepGoing)
    throw std::runtime_error(
        options.trajectory + ": has no pose at the time of any frame of " + rawlog);
  return report;
}

bool checkRawlog(
    const std::string& rawlog,
    bool imagesAnywhere,
    std::ostream& out,
    const ProgressCallback& progress)
{
  RawlogSource source(rawlog, readingOptions(rawlog, true, imagesAnywhere));
  std::vector<std::string> warnings;
  source.sendWarningsTo([&](const std::string& text) { warnings.push_back(text); });
  RawlogContent content;
  while (const auto frame = source.next())
  {
    progress(source.progress());
    content.add(*frame);
  }
  progress(1.0);
  content.odometryKind = source.odometryKind();
  FolderProblems problems;
  for (const auto& problem : source.problems()) problems["record"].push_back(problem.text());
  if (content.frames == 0)
    problems["no frame"].push_back("no usable RGB-D images (CObservation3DRangeScan)");
  addProblems(content, problems);

  out << oneLine(rawlog) << " (rawlog)\n"
      << mrpt::format(
             "  frames: %zu of %zu sensors in %.3f s\n", content.frames, content.sensors.size(),
             content.last - content.first);
  for (const auto& [label, sensor] : content.sensors) out << sensorText(label, sensor);
  if (content.frames > 0) out << posesText(content) << boxesText(content);
  out << "  records: " << oneLine(source.contentSummary()) << "\n";
  for (const auto& warning : warnings) out << "  note: " << oneLine(warning) << "\n";
  writeProblems(problems, out);
  return problems.empty();
}

}  // namespace quadmap
