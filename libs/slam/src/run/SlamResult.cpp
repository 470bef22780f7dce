#include "quadmap/slam/SlamResult.h"

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

SlamCounts SlamResult::counts() const
{
  SlamCounts sum;
  for (const auto& [sensor, counts] : countsBySensor) sum += counts;
  return sum;
}

}  // namespace quadmap
