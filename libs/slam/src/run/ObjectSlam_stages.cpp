// This file takes keyframes through the stages. ObjectSlam.cpp chooses them.
#include <algorithm>

#include "keyframes/BoxCounts.h"
#include "quadmap/base/ErrorText.h"
#include "run/ObjectSlam.h"

namespace quadmap
{
namespace
{
bool hasDepth(const mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto& depth = scan.rangeImage;
  return scan.hasRangeImage &&
         std::any_of(depth.data(), depth.data() + depth.size(), [](auto d) { return d != 0; });
}

}  // namespace

std::vector<StagePipeline::Stage> ObjectSlam::stages()
{
  std::vector<StagePipeline::Stage> stages;
  if (detection_.isActive()) stages.push_back({[this](std::size_t item) { detect(item); }});
  const StagePipeline::Feedback backEnd{stages.size() + 1, BackEndStage::kLag};
  stages.push_back({[this](std::size_t item) { measure(item); }, backEnd});
  stages.push_back({[this](std::size_t item) { addToMap(item); }});
  stages.push_back({[this](std::size_t item) { this->spool(item); }});
  return stages;
}

void ObjectSlam::detect(std::size_t item)
{
  KeyframeTask& keyframe = task(item);
  const auto scope = times_.measure("detection");
  try
  {
    detection_.detect(keyframe);
  }
  catch (const std::exception& e)  // of an image that the network cannot look at
  {
    if (!keepGoing_) throw BadFrame(keyframe.frame, rootMessage(e));
    keyframe.problem = rootMessage(e);
  }
}

void ObjectSlam::measure(std::size_t item)
{
  KeyframeTask& keyframe = task(item);
  if (!keyframe.boxes) return;
  const auto scope = times_.measure("perception");
  try
  {
    perception_.measure(keyframe, backEnd_.correctionFor(item));
    if (configuration_.slam.association == AssociationSource::Given)
      leaveOutAnonymous(*keyframe.boxes);
  }
  catch (const std::exception& e)  // OpenCV's, a failed allocation: nothing but this frame is lost
  {
    if (!keepGoing_) throw BadFrame(keyframe.frame, rootMessage(e));
    keyframe.problem = rootMessage(e);
  }
}

void ObjectSlam::addToMap(std::size_t item)
{
  const auto scope = times_.measure("map");
  try
  {
    backEnd_.add(item, task(item), result_);
  }
  catch (const std::exception& e)  // half of the frame may be in the map, so the run ends here
  {
    throw BadFrame(task(item).frame, rootMessage(e));
  }
}

void ObjectSlam::spool(std::size_t item)
{
  const KeyframeTask& keyframe = task(item);
  if (keyframe.problem) return;
  const auto scope = times_.measure("spool");
  spool_.append(*keyframe.frame.scan, keyframe.boxes.get());
}

void ObjectSlam::takeFinished()
{
  for (const std::size_t finished = pipeline_.finished(); taken_ < finished; ++taken_)
  {
    account(task(taken_));
    task(taken_) = {};
  }
}

void ObjectSlam::account(const KeyframeTask& keyframe)
{
  const RgbdFrame& frame = keyframe.frame;
  if (keyframe.problem)
  {
    badFrames_.emplace_back(frame, *keyframe.problem);
    return;
  }
  contradictions_.add(keyframe);
  objectsByLabel_ = keyframe.objectsByLabel;
  std::size_t objects = 0;
  for (const auto& [label, number] : objectsByLabel_) objects += number;
  const auto* boxes = keyframe.boxes.get();
  if (boxes && detection_.isActive()) lookThrough(*boxes);
  if (boxes) countBoxes(*boxes, labels_, result_.labels);
  SlamCounts& counts = result_.countsBySensor[frame.scan->sensorLabel];
  ++counts.keyframes;
  if (boxes) counts.boxes += boxes->objects.size();
  if (!frame.objects && !boxes) ++counts.keyframesWithoutBoxes;
  if (frame.objectsFromPixelLabels) ++counts.keyframesFromPixelLabels;
  if (!hasDepth(*frame.scan)) ++counts.keyframesWithoutDepth;
  MRPT_LOG_DEBUG_FMT(
      "keyframe %zu: record %zu (%s), %zu boxes, %zu objects in the map",
      taken_ - badFrames_.size(), frame.record, frame.scan->sensorLabel.c_str(),
      boxes ? boxes->objects.size() : 0, objects);
}

}  // namespace quadmap
