#include "TumImport.h"

#include <mrpt/core/format.h>

#include <optional>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/sensors/BoxCheck.h"

namespace quadmap
{
namespace
{
struct LoadedFrame
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;
  CObservationObjects::Ptr boxes;  // null when no detector looked
};

/** Notes what is left out with keepGoing, and throws without it. */
void drop(TumImportReport& report, const TumImportOptions& options, const std::string& what)
{
  if (!options.keepGoing) throw std::runtime_error(what);
  report.dropped.push_back(what);
}

CObservationObjects::Ptr loadBoxes(
    const TumDataset& dataset,
    std::size_t frame,
    const TumImportOptions& options,
    TumImportReport& report)
{
  const auto boxes = dataset.boxes(frame);
  if (!boxes) return nullptr;
  std::vector<DetectedObject> usable;
  for (const auto& object : boxes->objects)
  {
    const auto& camera = boxes->cameraParams;
    const auto why = whyUnusable(object.box, object.score, camera.ncols, camera.nrows);
    if (why)
      drop(report, options, dataset.boxesFile(frame) + ": " + object.label + " " + *why);
    else
      usable.push_back(object);
  }
  boxes->objects = std::move(usable);
  return boxes;
}

std::optional<LoadedFrame> load(
    const TumDataset& dataset,
    std::size_t frame,
    const TumImportOptions& options,
    TumImportReport& report)
try
{
  return LoadedFrame{dataset.scan(frame), loadBoxes(dataset, frame, options, report)};
}
catch (const std::exception& e)
{
  drop(report, options, rootMessage(e));
  return std::nullopt;
}
}  // namespace

TumImportReport importTum(
    const TumDataset& dataset,
    const TumImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress)
{
  TumImportReport report;
  const auto& frames = dataset.frames();
  std::optional<double> lastTime;  // of a frame [s]
  for (std::size_t i = 0; i < frames.size(); i += options.every)
  {
    progress(static_cast<double>(i) / static_cast<double>(frames.size()));
    if (lastTime && frames[i].time <= *lastTime)
    {
      drop(
          report, options,
          mrpt::format(
              "%s: time %.6f s is not after the frame before", frames[i].listed.c_str(),
              frames[i].time));
      continue;
    }
    const auto loaded = load(dataset, i, options, report);
    if (!loaded) continue;
    lastTime = frames[i].time;
    const auto T_world_robot = dataset.T_world_robot(i);
    if (T_world_robot && options.posesAs != PosesAs::None)
    {
      const bool odometry = options.posesAs == PosesAs::Odometry;
      writer.writePose(
          loaded->scan->timestamp, odometry ? kOdometryLabel : kGroundTruthLabel, *T_world_robot);
      ++report.poses;
    }
    writer.write(*loaded->scan);
    ++report.frames;
    if (!loaded->boxes && !dataset.boxesFile(i).empty()) ++report.withoutDetections;
    if (!loaded->boxes) continue;
    writer.write(*loaded->boxes);
    report.boxes += loaded->boxes->objects.size();
  }
  progress(1.0);
  return report;
}

}  // namespace quadmap
