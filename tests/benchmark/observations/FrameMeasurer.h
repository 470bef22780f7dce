#pragma once

#include "SceneRun.h"
#include "quadmap/perception/RoomPerception.h"

namespace quadmap::observations
{
/** Measures the frames of one walk once more, with other options than runScene() did. */
class FrameMeasurer
{
 public:
  FrameMeasurer(const PerceptionOptions& options, const LabelTable& labels) :
      perception_(options, labels)
  {
  }

  /** \param frame The next one of the walk. */
  CObservationObjects measure(const ObservedFrame& frame)
  {
    CObservationObjects boxes = *frame.simulated.objects;
    perception_.measure(*frame.simulated.scan, boxes, frame.T_map_sensor);
    return boxes;
  }

  /** What the edges of its boxes are judged by. \param frame The next one of the walk. */
  std::vector<std::optional<BoxEvidence>> edgeEvidence(const ObservedFrame& frame) const
  {
    return perception_.edgeEvidence(
        *frame.simulated.scan, *frame.simulated.objects, frame.T_map_sensor);
  }

 private:
  RoomPerception perception_;
};

}  // namespace quadmap::observations
