#include <mrpt/maps/CMetricMapEvents.h>

#include <algorithm>
#include <cmath>

#include "InsertionFrame.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/obs/PixelLabels.h"
#include "quadmap/perception/RoomPerception.h"

namespace quadmap
{
namespace
{
/** Has perception not looked at it? It measures every box, and the depth of a frame without any. */
bool needsMeasuring(const CObservationObjects& obs)
{
  const bool noneMeasured = std::all_of(
      obs.objects.begin(), obs.objects.end(),
      [](const DetectedObject& d) { return d.measurement.kind == MeasurementKind::None; });
  return noneMeasured && (!obs.objects.empty() || obs.coarseDepth.empty());
}

}  // namespace

bool CQuadricObjectMap::insertObservation(
    const mrpt::obs::CObservation& obs, const UncertainPose& robotPose)
{
  if (!genericMapParams.enableObservationInsertion || !insertAt(obs, robotPose)) return false;
  publishEvent(mrpt::maps::mrptEventMetricMapInsert(this, &obs, robotPose.mean));
  return true;
}

bool CQuadricObjectMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs, const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
  return insertAt(obs, UncertainPose(robotPose.value_or(mrpt::poses::CPose3D()), {0, 0}));
}

bool CQuadricObjectMap::insertAt(const mrpt::obs::CObservation& obs, const UncertainPose& robotPose)
{
  lastDecisions_.clear();
  heirs_.clear();
  std::optional<FramePairing::Frame> frame;
  if (const auto* boxes = dynamic_cast<const CObservationObjects*>(&obs); boxes)
  {
    if (!needsMeasuring(*boxes)) return insertObjects(*boxes, robotPose);
    frame = pairing_.add(*boxes, robotPose);
  }
  else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&obs); scan)
  {
    frame = pairing_.add(*scan);
    const auto labelled =
        frame ? nullptr
              : boxesFromPixelLabels(
                    *scan, labels(), perceptionOptions.minLabelPixels, unknownLabels_);
    if (labelled) frame = pairing_.add(*labelled, robotPose);
  }
  return frame && insertFrame(std::move(*frame));
}

bool CQuadricObjectMap::insertFrame(FramePairing::Frame frame)
{
  const mrpt::poses::CPose3D T_map_sensor = frame.robotPose.mean + frame.boxes.sensorPose;
  // The options may have changed since the last frame; the room has not.
  const FramePerception perception(perceptionOptions, labels());
  measureAndRemember(perception, *frame.scan, frame.boxes, T_map_sensor, room_);
  return insertObjects(frame.boxes, frame.robotPose);
}

bool CQuadricObjectMap::insertObjects(
    const CObservationObjects& obs, const UncertainPose& robotPose)
{
  for (const auto& detected : obs.objects)
    if (!labels().properties(detected.label).known) unknownLabels_.insert(detected.label);
  Frame frame = frameOf(obs, robotPose);
  associate(frame);
  std::set<ObjectId> touched;
  joinOrStart(frame, touched);
  together_.add(touched);
  std::set<ObjectId> looked = countMisses(frame, touched);
  looked.insert(touched.begin(), touched.end());
  for (const ObjectId id : touched)
    if (Entry& object = require(id); isDue(object)) estimate(object, false);
  judge(looked);
  mergeOverlapping(touched);
  return !touched.empty();
}

void CQuadricObjectMap::joinOrStart(const Frame& frame, std::set<ObjectId>& touched)
{
  lastDecisions_ = frame.decisions;
  for (std::size_t k = 0; k < frame.views.size(); ++k)
  {
    Decision& decision = lastDecisions_[k];
    const ImageBox& box = frame.allBoxes[frame.boxes[k]];
    const WaitingList::Entry entry{frame.views[k], frame.time, std::min(box.width(), box.height())};
    if (decision.object)
      addView(require(*decision.object), entry);
    else if (decision.startedObject)
      decision.object = startObject({entry});
    else if (const auto agreeing = waiting_.add(entry, labels(), insertionOptions.waiting);
             !agreeing.empty())
    {
      decision.object = startObject(agreeing);
      decision.startedObject = true;
    }
    if (!decision.object) continue;
    touched.insert(*decision.object);
    if (frame.instances[k]) objectOfInstance_[*frame.instances[k]] = *decision.object;
  }
}

ObjectId CQuadricObjectMap::startObject(const std::vector<WaitingList::Entry>& entries)
{
  std::deque<ObjectView> views;
  for (const auto& entry : entries) views.push_back(entry.view);
  const auto start = medianState(views, labels().properties(views.back().label));

  const ObjectId id = nextId_++;
  Entry& object = objects_[id];
  object.id = id;
  object.firstSeen = entries.front().time;
  object.object = ellipsoidOf(*start);
  for (const auto& entry : entries) addView(object, entry);
  return id;
}

/** The look is evidence that the object exists; the estimator keeps the view's measurement. */
void CQuadricObjectMap::addView(Entry& object, const WaitingList::Entry& entry)
{
  ++object.labelCounts[entry.view.label];
  ++(entry.view.complete ? object.completeCount : object.partialCount);
  object.firstSeen = std::min(object.firstSeen, entry.time);
  object.lastSeen = std::max(object.lastSeen, entry.time);
  object.looks.add(
      {entry.view.camera, mrpt::Clock::toDouble(entry.time), true, entry.boxSize},
      entry.view.center, insertionOptions.existence);
  if (auto view = measurementOf(object, entry.view, labels(), insertionOptions.agreement))
    object.estimator.add(std::move(*view), insertionOptions.estimator);
}

}  // namespace quadmap
