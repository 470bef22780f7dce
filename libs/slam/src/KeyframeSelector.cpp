#include "quadmap/slam/KeyframeSelector.h"

#include <mrpt/poses/Lie/SO.h>

#include "OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
void KeyframeOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(config, section, {"every", "minTranslation", "minRotation_deg", "maxInterval"});
  readNumber(config, section, "every", every, 0, 1000000);
  readNumber(config, section, "minTranslation", minTranslation, 0.0, 100.0);
  double minRotation_deg = mrpt::RAD2DEG(minRotation);
  readNumber(config, section, "minRotation_deg", minRotation_deg, 0.0, 180.0);
  minRotation = mrpt::DEG2RAD(minRotation_deg);
  readNumber(config, section, "maxInterval", maxInterval, 0.0, 1e6);
}

void KeyframeOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "every", every);
  config.write(section, "minTranslation", optionText(minTranslation));
  config.write(section, "minRotation_deg", optionText(mrpt::RAD2DEG(minRotation)));
  config.write(section, "maxInterval", optionText(maxInterval));
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
