#include "EdgeMeasurements.h"

#include <cmath>

#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
bool nearBorder(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge, double margin)
{
  switch (edge)
  {
    case BoxEdge::Left:
      return box.x1 < margin;
    case BoxEdge::Top:
      return box.y1 < margin;
    case BoxEdge::Right:
      return box.x2 > camera.width - 1 - margin;
    case BoxEdge::Bottom:
      return box.y2 > camera.height - 1 - margin;
  }
  return false;
}

ImageBox stripOutside(const ImageBox& box, BoxEdge edge, double width)
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

/** Share of the edge's length along which something nearer than the object stands outside it. */
double occludedShare(
    const DepthCloud& cloud,
    const ImageBox& box,
    BoxEdge edge,
    const EdgeContext& context,
    const PerceptionOptions& options)
{
  const auto strip = cloud.cellsOf(stripOutside(box, edge, options.occlusionStrip));
  const bool upright = edge == BoxEdge::Left || edge == BoxEdge::Right;
  const double margin = 0.05 + 3.0 * options.depthSigma(context.nearDepth);
  const auto isOccluder = [&](int c, int r)
  {
    if (!cloud.valid(c, r) || cloud.depth(c, r) > context.nearDepth - margin) return false;
    const double toSupport =
        context.support ? context.support->signedDistance(cloud.point(c, r).cast<double>()) : 1.0;
    return std::abs(toSupport) > 0.03 + 2.0 * options.depthSigma(cloud.depth(c, r));
  };
  int occluded = 0, length = 0;
  const int first = upright ? strip.r0 : strip.c0, last = upright ? strip.r1 : strip.c1;
  const int inner0 = upright ? strip.c0 : strip.r0, inner1 = upright ? strip.c1 : strip.r1;
  for (int i = first; i < last; ++i, ++length)
    for (int j = inner0; j < inner1; ++j)
      if (upright ? isOccluder(j, i) : isOccluder(i, j))
      {
        ++occluded;
        break;
      }
  return length > 0 ? static_cast<double>(occluded) / length : 0.0;
}

}  // namespace

std::array<EdgeMeasurement, 4> measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options)
{
  const auto& camera = cloud.camera();
  const auto planes = boxEdgePlanes(camera, box);
  std::array<EdgeMeasurement, 4> out;
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    const auto edge = static_cast<BoxEdge>(i);
    const bool upright = edge == BoxEdge::Left || edge == BoxEdge::Right;
    out[i].plane_sensor = planes[i];
    out[i].sigmaAngle =
        options.edgeSigmaIn(camera.width) / std::abs(upright ? camera.fx : camera.fy);
    if (nearBorder(camera, box, edge, options.borderMargin))
      out[i].state = EdgeState::NearImageBorder;
    else if (
        context.nearDepth > 0 &&
        occludedShare(cloud, box, edge, context, options) > options.occlusionShare)
      out[i].state = EdgeState::Occluded;
  }
  return out;
}

}  // namespace quadmap
