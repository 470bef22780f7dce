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
  /** Of its whole outline, exact, with nothing in front of it and no image border. Where an edge of
   * `box` lies within a pixel or two of it the object really ends; elsewhere the border of the
   * image or something nearer cuts it. */
  ImageBox outline;
};

/** The labelled objects of which enough can be seen, in the order of the scene. */
std::vector<VisibleObject> visibleObjects(
    const Scene& scene, const RenderedFrame& frame, const DetectorOptions& options);

/** What a detector says, and which object each box shows. */
struct Detections
{
  std::vector<DetectedObject> boxes;
  std::vector<std::optional<std::size_t>> truth;  //!< Index into Scene::objects; none: false alarm
};

/** What a detector makes of them: jittered boxes, misses, wrong labels, false alarms, scores. */
class SimulatedDetector
{
 public:
  /** \param labels Says which labels are mistaken for which. */
  SimulatedDetector(const Scene& scene, const DetectorOptions& options, const LabelTable& labels);

  /** May run concurrently. */
  Detections detect(
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
