#include "ObjectEnd.h"

#include <algorithm>
#include <limits>

namespace quadmap
{
namespace
{
constexpr double kShadow_px = 32.0;  // next to a depth edge, at most [px of an image 640 wide]
constexpr double kBorder_px = 12.0;  // where depth images are ragged [px of an image 640 wide]

}  // namespace

ObjectEnd::ObjectEnd(
    const DepthCloud& cloud,
    const EdgeContext& context,
    BoxEdge edge,
    const Occluders& occluders,
    const PerceptionOptions& options) :
    cloud_(cloud),
    object_(context.object),
    occluders_(occluders),
    upright_(isUpright(edge)),
    outwards_(edge == BoxEdge::Left || edge == BoxEdge::Top ? -1 : 1),
    strip_(std::max(2, cellsOf(options.occlusionStrip)))
{
  constexpr int kNone = std::numeric_limits<int>::min() / 2;
  std::vector<int> ends(static_cast<std::size_t>(upright_ ? cloud.rows() : cloud.columns()), kNone);
  int outermost = kNone;
  for (const auto& [c, r] : object_.cells)
  {
    int& last = ends[static_cast<std::size_t>(upright_ ? r : c)];
    last = std::max(last, outwards_ * (upright_ ? c : r));
    outermost = std::max(outermost, last);
  }
  const double tolerance = options.edgeToleranceIn(cloud.camera().width) / cloud.stride();
  for (std::size_t line = 0; line < ends.size(); ++line)
    if (ends[line] != kNone && outermost - ends[line] <= tolerance)
      ends_.push_back({static_cast<int>(line), ends[line]});
}

int ObjectEnd::cellsOf(double pixels) const
{
  return static_cast<int>(PerceptionOptions::scaledPixels(pixels, cloud_.camera().width)) /
         cloud_.stride();
}

template <typename IsIt>
double ObjectEnd::share(const IsIt& isIt) const
{
  return ends_.empty() ? 0.0
                       : static_cast<double>(std::count_if(ends_.begin(), ends_.end(), isIt)) /
                             static_cast<double>(ends_.size());
}

double ObjectEnd::shareBehind() const
{
  return share([&](const End& end) { return isNearerBeyond(end); });
}

double ObjectEnd::shareBeside() const
{
  return share([&](const End& end) { return isNearerBeside(end, 1) || isNearerBeside(end, -1); });
}

double ObjectEnd::shareAtBorder() const
{
  const int last = (upright_ ? cloud_.rows() : cloud_.columns()) - 1;
  const int margin = cellsOf(kBorder_px);
  return share([&](const End& end) { return std::min(end.line, last - end.line) < margin; });
}

double ObjectEnd::depthLimit(const End& end) const
{
  const auto own = cell(end.line, end.position);
  const double depth = cloud_.depth(own.c, own.r);
  return depth - occluders_.depthMargin(depth);
}

bool ObjectEnd::isNearerBeyond(const End& end) const
{
  const double limit = depthLimit(end);
  for (int k = 1; k <= strip_; ++k)
  {
    const auto [c, r] = cell(end.line, end.position + k);
    if (cloud_.inside(c, r) && occluders_.isNearer(c, r, limit)) return true;
  }
  return false;
}

/** Beyond the object's own cells and the shadow of what stands there.
 * \param direction Along the edge, 1 or -1. */
bool ObjectEnd::isNearerBeside(const End& end, int direction) const
{
  const double limit = depthLimit(end);
  const int reach = cellsOf(kShadow_px);
  int seen = 0;  // with depth, in a row
  for (int k = 1; k <= reach && seen < strip_; ++k)
  {
    const auto [c, r] = cell(end.line + direction * k, end.position);
    if (!cloud_.inside(c, r)) return false;
    if (object_.mask.contains(c, r))
    {
      seen = 0;
      continue;
    }
    if (occluders_.isNearer(c, r, limit)) return true;
    seen += cloud_.valid(c, r) ? 1 : 0;
  }
  return false;
}

}  // namespace quadmap
