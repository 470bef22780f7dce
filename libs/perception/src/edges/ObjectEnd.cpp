#include "edges/ObjectEnd.h"

#include <algorithm>
#include <limits>

namespace quadmap
{
ObjectEnd::ObjectEnd(
    const DepthCloud& cloud,
    const EdgeContext& context,
    BoxEdge edge,
    const PerceptionOptions& options) :
    cloud_(cloud),
    edge_(edge),
    upright_(isUpright(edge)),
    outwards_(edge == BoxEdge::Left || edge == BoxEdge::Top ? -1 : 1)
{
  constexpr int kNone = std::numeric_limits<int>::min() / 2;
  std::vector<int> ends(static_cast<std::size_t>(upright_ ? cloud.rows() : cloud.columns()), kNone);
  outermost_ = kNone;
  for (const auto& [c, r] : context.object.cells)
  {
    int& last = ends[static_cast<std::size_t>(upright_ ? r : c)];
    last = std::max(last, outwards_ * (upright_ ? c : r));
    outermost_ = std::max(outermost_, last);
  }
  const double tolerance = options.edgeToleranceIn(cloud.camera().width) / cloud.stride();
  for (std::size_t line = 0; line < ends.size(); ++line)
    if (ends[line] != kNone && outermost_ - ends[line] <= tolerance)
      lines_.push_back(static_cast<int>(line));
}

double ObjectEnd::shareAtBorder() const
{
  if (lines_.empty()) return 0;
  constexpr double kRagged_px = 12.0;  // depth images are, along their border [640 px wide]
  const double margin =
      PerceptionOptions::scaledPixels(kRagged_px, cloud_.camera().width) / cloud_.stride();
  const int last = (upright_ ? cloud_.rows() : cloud_.columns()) - 1;
  const auto atBorder = std::count_if(
      lines_.begin(), lines_.end(), [&](int line) { return std::min(line, last - line) < margin; });
  return static_cast<double>(atBorder) / static_cast<double>(lines_.size());
}

double ObjectEnd::shortOf(const ImageBox& box) const
{
  if (lines_.empty()) return 0;
  const int outside = outwards_ > 0 ? outermost_ + 1 : outermost_;  // where its cell ends
  const double edge[4] = {-box.x1, -box.y1, box.x2, box.y2};
  return edge[static_cast<std::size_t>(edge_)] - outside * cloud_.stride();
}

}  // namespace quadmap
