#pragma once

#include <algorithm>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/perception/BoxEdges.h"

namespace quadmap
{
inline bool isUpright(BoxEdge edge) { return edge == BoxEdge::Left || edge == BoxEdge::Right; }

/** The strip of this width [px] outside an edge of a box; inside when it is negative. */
inline ImageBox stripOutside(const ImageBox& box, BoxEdge edge, double width)
{
  switch (edge)
  {
    case BoxEdge::Left:
      return {box.x1 - width, box.y1, box.x1, box.y2};
    case BoxEdge::Top:
      return {box.x1, box.y1 - width, box.x2, box.y1};
    case BoxEdge::Right:
      return {box.x2, box.y1, box.x2 + width, box.y2};
    default:
      return {box.x1, box.y2, box.x2, box.y2 + width};
  }
}

/** The quarter of a box along one of its edges. */
inline ImageBox quarterInside(const ImageBox& box, BoxEdge edge)
{
  const double depth = 0.25 * (isUpright(edge) ? box.width() : box.height());
  const ImageBox inwards = stripOutside(box, edge, -depth);
  return {
      std::min(inwards.x1, inwards.x2), std::min(inwards.y1, inwards.y2),
      std::max(inwards.x1, inwards.x2), std::max(inwards.y1, inwards.y2)};
}

}  // namespace quadmap
