#pragma once

#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** One observation while it is inserted. */
struct CQuadricObjectMap::Frame
{
  FrameGeometry geometry;
  mrpt::Clock::time_point time;
  std::vector<ImageBox> allBoxes;  // of the observation

  // The usable measurements; `decisions` has the same order.
  std::vector<std::size_t> boxes;  // index in the observation
  std::vector<std::optional<std::uint32_t>> instances;
  std::vector<ObjectView> views;
  std::vector<Decision> decisions;
};

}  // namespace quadmap
