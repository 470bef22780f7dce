// This file says what is wrong with the result. ObjectSlam.cpp chooses the keyframes.
#include <algorithm>

#include "run/ObjectSlam.h"

namespace quadmap
{
void ObjectSlam::warnOfMissingDepth()
{
  const bool several = result_.countsBySensor.size() > 1;
  for (const auto& [sensor, counts] : result_.countsBySensor)
    if (counts.keyframesWithoutDepth > 0)
      warnOfInput(mrpt::format(
          "%zu of %zu keyframes%s have no valid depth at all", counts.keyframesWithoutDepth,
          counts.keyframes, several ? (" of " + sensor).c_str() : ""));
}

void ObjectSlam::warnOfDroppedFloors()
{
  result_.droppedFloors = perception_.room().droppedFloors();
  if (result_.droppedFloors > 0)
    warnOfInput(mrpt::format(
        "what was taken for the floor was given up %zu times, because more keyframes showed things "
        "below it than had shown it",
        result_.droppedFloors));
}

void ObjectSlam::warnOfNoisyOdometry()
{
  constexpr double kNotable = 1.5;  // less is said in report.json alone
  if (!result_.correction) return;
  const StepNoise& noise = result_.correction->stepNoise;
  if (std::max(noise.position, noise.angle) >= kNotable)
    warnOfInput(mrpt::format(
        "the odometry errs by more than it claims: positions by %.1f and angles by %.1f times as "
        "much; it was trusted so much less",
        noise.position, noise.angle));
}

void ObjectSlam::warnOfOpenLoop()
{
  if (result_.loops.closed > 0)
    MRPT_LOG_INFO_FMT("loops closed by objects: %i", result_.loops.closed);
  if (const auto text = result_.loops.warning(); !text.empty()) warnOfInput(text);
}

void ObjectSlam::warnOfThingsNotFoundAgain()
{
  constexpr std::size_t kFewest = 3;  // fewer may have been taken away
  const auto [found, missed] = result_.map.revisits();
  MRPT_LOG_DEBUG_FMT("objects come back to: %zu found, %zu missed", found, missed);
  if (missed >= kFewest && missed > found)
    warnOfInput(mrpt::format(
        "%zu of %zu objects that the robot came back to were gone: unless they were taken away, "
        "poses and objects are doubtful",
        missed, found + missed));
}

void ObjectSlam::warnOfDoubtfulPoses()
{
  for (const auto& text : {odometry_.warningOfJumps(), contradictions_.warning()})
    if (!text.empty()) warnOfInput(text);
}

}  // namespace quadmap
