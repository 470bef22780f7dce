#pragma once

#include <algorithm>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
/** Width of what is looked at around a box [px]: 15 % of its longer side, where boxes of
 * detectors end beside their objects and what is near the object in the image is mostly near it in
 * the room; at least some pixels, because tight boxes of small things show nothing around them. */
inline double surroundingWidth(const ImageBox& box)
{
  return std::max(8.0, 0.15 * std::max(box.width(), box.height()));
}

/** The box with its surroundings [px]. */
inline ImageBox withSurroundings(const ImageBox& box)
{
  const double width = surroundingWidth(box);
  return {box.x1 - width, box.y1 - width, box.x2 + width, box.y2 + width};
}

}  // namespace quadmap
