#include "FolderImport.h"

#include <optional>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/obs/KeepGreatest.h"
#include "quadmap/obs/TimeOrder.h"

namespace quadmap
{
namespace
{
struct LoadedFrame
{
  RecordedFrame images;
  CObservationObjects::Ptr boxes;  // null when no detector looked
};

/** Notes what is left out with keepGoing, and throws without it. */
void drop(FolderImportReport& report, const FolderImportOptions& options, const std::string& what)
{
  if (!options.keepGoing) throw std::runtime_error(what);
  report.dropped.push_back(what);
}

/** Leaves as many boxes as an image may have. \return How many were left out. */
std::size_t keepSurest(std::vector<DetectedObject>& objects)
{
  return keepGreatest(
      objects, CObservationObjects::kMostObjects,
      [](const DetectedObject& object) { return object.score; });
}

CObservationObjects::Ptr loadBoxes(
    const FrameFolder& folder,
    std::size_t frame,
    const FolderImportOptions& options,
    FolderImportReport& report)
{
  const auto boxes = folder.boxes(frame);
  if (!boxes) return nullptr;
  const auto unusable = folder.unusableBoxes(frame, *boxes);
  std::vector<DetectedObject> usable;
  for (std::size_t i = 0; i < boxes->objects.size(); ++i)
    if (const auto why = unusable.find(i); why != unusable.end())
      drop(report, options, why->second);
    else
      usable.push_back(boxes->objects[i]);
  const std::size_t found = usable.size();
  if (keepSurest(usable) > 0 && report.crowdedImages++ == 0)
    report.firstCrowded = folder.boxesFile(frame) + " (" + std::to_string(found) + " boxes)";
  boxes->objects = std::move(usable);
  return boxes;
}

std::optional<LoadedFrame> load(
    const FrameFolder& folder,
    std::size_t frame,
    const FolderImportOptions& options,
    FolderImportReport& report)
try
{
  return LoadedFrame{folder.recorded(frame), loadBoxes(folder, frame, options, report)};
}
catch (const std::exception& e)
{
  drop(report, options, rootMessage(e));
  return std::nullopt;
}

/** Of every n-th frame [s]. */
std::vector<double> timesOf(const std::vector<FolderFrame>& frames, std::size_t every)
{
  std::vector<double> times;
  for (std::size_t i = 0; i < frames.size(); i += every) times.push_back(frames[i].time);
  return times;
}
}  // namespace

FolderImportReport importFolder(
    const FrameFolder& folder,
    const FolderImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress)
{
  FolderImportReport report;
  for (const auto& problem : folder.listProblems()) drop(report, options, problem);
  if (options.posesAs != PosesAs::None)
    for (const auto& problem : folder.posesProblems()) drop(report, options, problem);
  const auto& frames = folder.frames();
  const auto times = timesOf(frames, options.every);
  std::optional<double> lastTime;  // of a frame [s]
  for (std::size_t i = 0; i < frames.size(); i += options.every)
  {
    progress(static_cast<double>(i) / static_cast<double>(frames.size()));
    if (const auto why = whyOutOfOrder(times, i / options.every, lastTime, "frame"))
    {
      drop(report, options, frames[i].listed + ": " + *why);
      continue;
    }
    const auto loaded = load(folder, i, options, report);
    if (!loaded) continue;
    if (!frames[i].poseProblem.empty() && options.posesAs != PosesAs::None)
      drop(report, options, frames[i].poseProblem);
    lastTime = frames[i].time;
    const auto T_world_robot = folder.T_world_robot(i);
    if (T_world_robot && options.posesAs != PosesAs::None)
    {
      const bool odometry = options.posesAs == PosesAs::Odometry;
      writer.writePose(
          loaded->images.scan->timestamp, odometry ? kOdometryLabel : kGroundTruthLabel,
          *T_world_robot);
      ++report.poses;
    }
    const auto& [scan, jpeg] = loaded->images;
    if (jpeg.empty())
      writer.write(*scan);
    else
      writer.write(*scan, jpeg);
    report.copiedImages += jpeg.empty() ? 0 : 1;
    ++report.frames;
    if (!loaded->boxes && folder.hasDetections() && report.withoutDetections++ == 0)
      report.firstWithoutDetections = folder.boxesFile(i);
    if (!loaded->boxes) continue;
    writer.write(*loaded->boxes);
    report.boxes += loaded->boxes->objects.size();
  }
  progress(1.0);
  return report;
}

}  // namespace quadmap
