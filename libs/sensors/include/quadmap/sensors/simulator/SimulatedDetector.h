#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/sensors/simulator/RandomStream.h"
#include "quadmap/sensors/simulator/RayCaster.h"

namespace quadmap::simulator
{
/** What is in the image of one labelled object. */
struct VisibleObject
{
  std::size_t object = 0;   //!< Index into Scene::objects
  ImageBox box;             //!< Of its visible pixels, exact
  double visibleShare = 0;  //!< Visible pixels to those of its whole outline, in [0, 1]
};

/** The labelled objects of which enough can be seen, in the order of the scene. */
std::vector<VisibleObject> visibleObjects(
    const Scene& scene, const RenderedFrame& frame, const DetectorOptions& options);

/** What a detector makes of them: jittered boxes, misses, wrong labels, false alarms, scores. */
class SimulatedDetector
{
 public:
  /** \param labels Says which labels are mistaken for which. */
  SimulatedDetector(const Scene& scene, const DetectorOptions& options, const LabelTable& labels);

  /** May run concurrently. */
  std::vector<DetectedObject> detect(
      const std::vector<VisibleObject>& visible,
      const PinholeCamera& camera,
      RandomStream& random) const;

 private:
  DetectedObject detection(
      const VisibleObject& seen, const PinholeCamera& camera, RandomStream& random) const;
  DetectedObject falseAlarm(const PinholeCamera& camera, RandomStream& random) const;
  std::string possiblyWrongLabel(const std::string& label, RandomStream& random) const;

  const Scene& scene_;
  DetectorOptions options_;
  const LabelTable& labels_;
  std::vector<std::string> sceneLabels_;  // each once: what false alarms are called
};

}  // namespace quadmap::simulator
