#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** A keyframe on its way from the input to the map. */
struct KeyframeTask
{
  RgbdFrame frame;
  mrpt::poses::CPose3D T_odom_robot;
  /** Motion since the keyframe before by odometry. The first keyframe has none. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> step = std::nullopt;
  CObservationObjects::Ptr boxes = nullptr;  //!< Boxes to measure; null when there are none

  std::optional<std::string> problem = std::nullopt;  //!< The reason to leave it out
  /** Number of confirmed objects of each label when it was added. */
  std::map<std::string, std::size_t> objectsByLabel = {};
};

}  // namespace quadmap
