#pragma once

#include "SceneRun.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPlanes.h"

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
    const Eigen::Vector3d up_sensor =
        frame.T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
    known_.add(
        perception_.measure(
            *frame.simulated.scan, boxes, up_sensor, known_.around(frame.T_map_sensor)),
        frame.T_map_sensor);
    return boxes;
  }

 private:
  FramePerception perception_;
  RoomPlanes known_;
};

}  // namespace quadmap::observations
