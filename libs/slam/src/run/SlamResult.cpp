#include "quadmap/slam/SlamResult.h"

#include <mrpt/core/format.h>

namespace quadmap
{
SlamCounts& SlamCounts::operator+=(const SlamCounts& other)
{
  frames += other.frames;
  framesWithoutPose += other.framesWithoutPose;
  keyframes += other.keyframes;
  keyframesWithoutBoxes += other.keyframesWithoutBoxes;
  keyframesWithoutDepth += other.keyframesWithoutDepth;
  keyframesFromPixelLabels += other.keyframesFromPixelLabels;
  boxes += other.boxes;
  return *this;
}

std::string LoopSummary::warning() const
{
  if (stopped)
    return "the run was stopped before it was known what is in the map twice: poses and objects "
           "may be doubtful";
  if (!open) return {};
  return mrpt::format(
      "%zu objects may be twice in the map, up to %.1f m apart, and could not be made one: poses "
      "and objects are doubtful",
      open->objects, open->distance);
}

SlamCounts SlamResult::counts() const
{
  SlamCounts sum;
  for (const auto& [sensor, counts] : countsBySensor) sum += counts;
  return sum;
}

}  // namespace quadmap
