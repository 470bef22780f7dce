#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/simulator/RandomStream.h"
#include "quadmap/simulator/RayCaster.h"

namespace quadmap::simulator
{
/** The part of one labelled object that is in the image. */
struct VisibleObject
{
  std::size_t object = 0;   //!< Index into Scene::objects
  ImageBox box;             //!< Exact box of its visible pixels
  double visibleShare = 0;  //!< Visible share of the pixels of its outline, in [0, 1]
  /** Exact box of its whole outline, as if nothing were in front of it and the image had no border.
   * The object really ends where an edge of `box` is within a pixel or two of this one. Elsewhere
   * the border of the image cuts it, or something nearer occludes it. */
  ImageBox outline;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();  //!< Place of the camera in the object's frame [m]
};

/** The labelled objects of which enough can be seen, in the order of the scene. */
std::vector<VisibleObject> visibleObjects(
    const Scene& scene, const RenderedFrame& frame, const DetectorOptions& options);

/** The boxes of a detector, and which object each of them shows. */
struct Detections
{
  std::vector<DetectedObject> boxes;
  std::vector<std::optional<std::size_t>> truth;  //!< Index into Scene::objects; empty: false alarm
};

/** Makes the boxes of a detector from the visible objects: with errors of the edges, misses, wrong
 * labels, false alarms and scores. */
class SimulatedDetector
{
 public:
  /** \param labels Says which labels are mistaken for which.
   *  \param seed Random seed of the errors that stay while the view stays. */
  SimulatedDetector(
      const Scene& scene,
      const DetectorOptions& options,
      const LabelTable& labels,
      std::uint64_t seed = 0);

  /** It may run concurrently. \param blur Length of the motion of the pixels [px]. */
  Detections detect(
      const std::vector<VisibleObject>& visible,
      const PinholeCamera& camera,
      RandomStream& random,
      double blur = 0) const;

 private:
  /** The box and the label by which a network takes an object. */
  struct TakenObject
  {
    ImageBox box;
    std::string label;
    bool isMissed = false;
  };

  /** The objects as a network takes them, which errs in the same way while the view stays. */
  std::vector<TakenObject> taken(const std::vector<VisibleObject>& visible) const;
  void mergeWithNeighbour(
      std::size_t index,
      const std::vector<VisibleObject>& visible,
      std::vector<TakenObject>& taken,
      bool hidesNeighbour) const;
  DetectedObject detection(
      const TakenObject& taken,
      const VisibleObject& seen,
      const PinholeCamera& camera,
      RandomStream& random,
      double blur) const;
  DetectedObject falseAlarm(const PinholeCamera& camera, RandomStream& random) const;
  std::string wrongLabel(const std::string& label, double which) const;
  std::string possiblyWrongLabel(const std::string& label, RandomStream& random) const;

  const Scene& scene_;
  DetectorOptions options_;
  const LabelTable& labels_;
  std::uint64_t seed_;
  std::vector<std::string> sceneLabels_;  // labels of the scene, each once, for false alarms
};

}  // namespace quadmap::simulator
