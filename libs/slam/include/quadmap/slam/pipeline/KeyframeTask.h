#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
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
  /** Motion since the keyframe before, by the input; the first has none. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> step = std::nullopt;
  CObservationObjects::Ptr boxes = nullptr;  //!< To be measured; null: none, or nobody wants them

  std::optional<std::string> problem = std::nullopt;  //!< Why it has to be left out
  std::size_t objectsInMap = 0;                       //!< When it was added
};

}  // namespace quadmap
