#include "quadmap/sensors/KeyframeSelector.h"

#include <mrpt/poses/Lie/SO.h>

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void KeyframeOptions::describe(OptionList& list)
{
  list.about("Which frames are worth a look at their objects. Every sensor is judged for itself.");
  list.integer(
      "every", every, {0, 1000000}, "",
      "Every n-th frame of a sensor is a keyframe, as with --every. 0 decides by motion, with the "
      "options below.");
  list.number(
      "minTranslation", minTranslation, {0, 100}, "m",
      "A sensor that moved this far gives a keyframe.");
  list.angle(
      "minRotation_deg", minRotation, {0, 180}, "A sensor that turned this much gives a keyframe.");
  list.number(
      "maxInterval", maxInterval, {0, 1e6}, "s",
      "A sensor that gave no keyframe for this long gives one.");
}

bool KeyframeSelector::isKeyframe(
    const std::string& sensor, double time, const mrpt::poses::CPose3D& T_map_sensor)
{
  const auto last = lastBySensor_.find(sensor);
  if (last != lastBySensor_.end())
  {
    ++last->second.framesSince;
    if (!isFarEnough(last->second, time, T_map_sensor)) return false;
  }
  lastBySensor_[sensor] = {time, T_map_sensor, 0};
  return true;
}

bool KeyframeSelector::isFarEnough(
    const LastKeyframe& last, double time, const mrpt::poses::CPose3D& T_map_sensor) const
{
  if (options_.every > 0) return last.framesSince >= options_.every;
  const mrpt::poses::CPose3D T_last_sensor = T_map_sensor - last.T_map_sensor;
  const double turned =
      mrpt::poses::Lie::SO<3>::log(T_last_sensor.getRotationMatrix()).norm();  // [rad]
  return T_last_sensor.norm() >= options_.minTranslation || turned >= options_.minRotation ||
         time - last.time >= options_.maxInterval;
}

}  // namespace quadmap
