#pragma once

#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** One observation while it is inserted. */
struct CQuadricObjectMap::Frame
{
  FrameGeometry geometry;
  mrpt::Clock::time_point time;
  // All boxes of the observation; a label is empty where the detector is not sure enough.
  std::vector<ImageBox> allBoxes;
  std::vector<std::string> allLabels;
  std::vector<std::size_t> boxesWithoutPlace;  // sure ones whose measurement gives no view

  // The usable measurements; `decisions` has the same order.
  std::vector<std::size_t> boxes;  // index in the observation
  std::vector<std::optional<std::uint32_t>> instances;
  std::vector<ObjectView> views;
  std::vector<Decision> decisions;
};

}  // namespace quadmap
