#include "DetectionStage.h"

#include "quadmap/detection/FrameDetection.h"

namespace quadmap
{
DetectionStage::DetectionStage(const SlamOptions& options)
{
  if (options.findsBoxes()) detector_ = loadDetector(options.detector);
}

DetectionStage::~DetectionStage() = default;

void DetectionStage::detect(KeyframeTask& task)
{
  task.boxes = detectObjects(task.frame, *detector_);
}

}  // namespace quadmap
