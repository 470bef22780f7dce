#include "edges/ObjectEnd.h"

#include <algorithm>
#include <limits>

namespace quadmap
{
namespace
{
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
    edge_(edge),
    upright_(isUpright(edge)),
    outwards_(edge == BoxEdge::Left || edge == BoxEdge::Top ? -1 : 1),
    strip_(std::max(2, cellsOf(options.occlusionStrip)))
{
  constexpr int kNone = std::numeric_limits<int>::min() / 2;
  std::vector<int> ends(static_cast<std::size_t>(upright_ ? cloud.rows() : cloud.columns()), kNone);
  outermost_ = kNone;
  for (const auto& [c, r] : object_.cells)
  {
    int& last = ends[static_cast<std::size_t>(upright_ ? r : c)];
    last = std::max(last, outwards_ * (upright_ ? c : r));
    outermost_ = std::max(outermost_, last);
  }
  const double tolerance = options.edgeToleranceIn(cloud.camera().width) / cloud.stride();
  for (std::size_t line = 0; line < ends.size(); ++line)
    if (ends[line] != kNone && outermost_ - ends[line] <= tolerance)
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

double ObjectEnd::shareAtBorder() const
{
  const int last = (upright_ ? cloud_.rows() : cloud_.columns()) - 1;
  const int margin = cellsOf(kBorder_px);
  return share([&](const End& end) { return std::min(end.line, last - end.line) < margin; });
}

double ObjectEnd::shortOf(const ImageBox& box) const
{
  if (ends_.empty()) return 0;
  const int outside = outwards_ > 0 ? outermost_ + 1 : outermost_;  // where its cell ends
  const double edge[4] = {-box.x1, -box.y1, box.x2, box.y2};
  return edge[static_cast<std::size_t>(edge_)] - outside * cloud_.stride();
}

bool ObjectEnd::isNearerBeyond(const End& end) const
{
  const auto own = cell(end.line, end.position);
  const double depth = cloud_.depth(own.c, own.r);
  const double limit = depth - occluders_.depthMargin(depth);
  for (int k = 1; k <= strip_; ++k)
  {
    const auto [c, r] = cell(end.line, end.position + k);
    if (cloud_.inside(c, r) && occluders_.isNearer(c, r, limit)) return true;
  }
  return false;
}

}  // namespace quadmap
