#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <map>
#include <string>

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** Which frames become keyframes: section [keyframes] of the configuration. */
struct KeyframeOptions : public OptionGroup
{
  int every = 0;                 //!< Every n-th frame of a sensor; 0 to choose by motion
  double minTranslation = 0.05;  //!< A sensor that moved farther gives a keyframe [m], >= 0
  double minRotation = fromDegrees(2.0L);  //!< ... or turned more [rad], >= 0; INI in degrees
  double maxInterval = 1.0;                //!< ... or gave none for longer [s], >= 0

 private:
  void describe(OptionList& list) override;
};

/** Chooses the keyframes of each sensor by itself. The first frame of a sensor is always one. */
class KeyframeSelector
{
 public:
  explicit KeyframeSelector(const KeyframeOptions& options) : options_(options) {}

  /** \param sensor Label of the sensor.
   *  \param time Time of the frame [s].
   *  \param T_map_sensor Pose of the sensor at this time.
   *  \return True when the frame is a keyframe. The next frames are then compared with it. */
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
