#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/KeyframeTask.h"

namespace quadmap
{
/** Finds steps of the odometry that the objects contradict. By such a step several objects that two
 * successive keyframes of a sensor show have moved alike, and none of them has stayed where it was.
 * The odometry jumped then, or it did not notice that the robot was carried. */
class ContradictedSteps
{
 public:
  /** Takes the next keyframe, whose boxes are measured. */
  void add(const KeyframeTask& keyframe);

  /** What to tell the user after the last keyframe, one line; empty when there are no such steps.
   */
  std::string warning() const;

 private:
  /** Label and centre of each object of a keyframe, in the frame of the odometry [m]. */
  using View = std::vector<std::pair<std::string, Eigen::Vector3d>>;
  static View viewOf(const KeyframeTask& keyframe);
  static std::size_t agreeing(const View& before, const View& now, const Eigen::Vector3d& shift);

  std::map<std::string, View> lastViews_;  // by sensor
  std::size_t count_ = 0;
  std::string first_;  // Description of the first such step
};

}  // namespace quadmap
