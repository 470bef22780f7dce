#pragma once

#include <memory>

#include "KeyframeTask.h"
#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
class Detector;

/** Finds the boxes of keyframes, one keyframe after the other, when a detector is asked for. */
class DetectionStage
{
 public:
  /** \exception std::exception As of loadDetector(). */
  explicit DetectionStage(const SlamOptions& options);

  ~DetectionStage();

  bool isActive() const { return detector_ != nullptr; }

  /** Call it when isActive(). A keyframe without colour image keeps no boxes.
   *  \exception std::runtime_error If the frame cannot be used. */
  void detect(KeyframeTask& task);

 private:
  std::unique_ptr<Detector> detector_;  //!< Null when the input has the boxes
};

}  // namespace quadmap
