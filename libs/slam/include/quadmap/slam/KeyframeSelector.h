#pragma once

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <map>
#include <string>

namespace quadmap
{
/** Which frames are worth a look at their objects. Section [keyframes] of the configuration. */
struct KeyframeOptions : public mrpt::config::CLoadableOptions
{
  int every = 0;                 //!< Every n-th frame of a sensor; 0: by motion, as below
  double minTranslation = 0.05;  //!< A sensor that moved this far [m] gives a keyframe, >= 0
  double minRotation = mrpt::DEG2RAD(2.0);  //!< ... or turned this much [rad], >= 0; INI in degrees
  double maxInterval = 1.0;                 //!< ... or was quiet for this long [s], >= 0

  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) override;
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const override;
};

/** Picks keyframes, each sensor for itself. The first frame of a sensor is always one. */
class KeyframeSelector
{
 public:
  explicit KeyframeSelector(const KeyframeOptions& options) : options_(options) {}

  /** \param sensor Label of the sensor.
   *  \param time [s].
   *  \param T_map_sensor Where the sensor was.
   *  \return True when the frame is a keyframe; the next ones are then compared with it. */
  bool isKeyframe(const std::string& sensor, double time, const mrpt::poses::CPose3D& T_map_sensor);

 private:
  struct LastKeyframe
  {
    double time = 0;
    mrpt::poses::CPose3D T_map_sensor;
    int framesSince = 0;  //!< Frames of the sensor after it
  };
  bool isFarEnough(
      const LastKeyframe& last, double time, const mrpt::poses::CPose3D& T_map_sensor) const;

  KeyframeOptions options_;
  std::map<std::string, LastKeyframe> lastBySensor_;
};

}  // namespace quadmap
