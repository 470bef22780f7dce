#include "EdgeMeasurements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "HiddenPart.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/perception/BoxEdges.h"

namespace quadmap
{
namespace
{
/** More of an edge than this bounded by something nearer, and the object is in contact with it. */
constexpr double kContactShare = 0.1;
/** Between a box edge and the border of the image; detectors err by as much where it cuts an object
 * [px of an image 640 wide]. */
constexpr double kMinStrip_px = 8.0;
/** An object's lower end is this quantile of its points' heights; some are stray ones. */
constexpr double kLowestPart = 0.02;

bool isUpright(BoxEdge edge) { return edge == BoxEdge::Left || edge == BoxEdge::Right; }

/** Options in pixels are meant for images of this width, and grow with the image. */
double scaledPixels(const DepthCloud& cloud, double pixels)
{
  return PerceptionOptions::scaledPixels(pixels, cloud.camera().width);
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

/** The quarter of a box along one of its edges. */
ImageBox quarterInside(const ImageBox& box, BoxEdge edge)
{
  const double depth = 0.25 * (isUpright(edge) ? box.width() : box.height());
  const ImageBox inwards = stripOutside(box, edge, -depth);
  return {
      std::min(inwards.x1, inwards.x2), std::min(inwards.y1, inwards.y2),
      std::max(inwards.x1, inwards.x2), std::max(inwards.y1, inwards.y2)};
}

/** Some thousand values give a quantile as well as all do. */
std::size_t sampleStep(std::size_t count) { return 1 + count / 2000; }

/** Judges the edges of one box. */
class EdgeJudge
{
 public:
  EdgeJudge(
      const DepthCloud& cloud,
      const ImageBox& box,
      const EdgeContext& context,
      const PerceptionOptions& options) :
      cloud_(cloud), box_(box), context_(context), options_(options), inside_(cloud.cellsOf(box))
  {
    if (!context.object.empty()) lowest_ = lowestHeight();
    for (const auto& screen : context.screens)
      if (!showOneThing(screen.box, box))
        screens_.push_back({cloud.cellsOf(screen.box), screen.depth});
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto edge = static_cast<BoxEdge>(i);
      const double depth = depthNear(edge);
      nearBorder_[i] = isNearBorder(edge, depth);
      nearer_[i] = nearerShare(edge, depth);
      touching_[i] = nearer_[i] > 0 ? nearer_[i] * nearerShareAtEnd(edge) : 0.0;
    }
    floating_ = floating();
  }

  EdgeState state(BoxEdge edge) const
  {
    const auto i = static_cast<std::size_t>(edge);
    if (nearBorder_[i]) return EdgeState::NearImageBorder;
    return hiddenProbability(sideOf(edge), evidence(edge)) > options_.maxHiddenProbability
               ? EdgeState::Occluded
               : EdgeState::Usable;
  }

 private:
  ObjectSide sideOf(BoxEdge edge) const
  {
    constexpr double kMinCosine = 0.7;
    const double outwardsUp = -boxEdgePlane(cloud_.camera(), box_, edge).n.dot(context_.up);
    return outwardsUp > kMinCosine    ? ObjectSide::Top
           : outwardsUp < -kMinCosine ? ObjectSide::Bottom
                                      : ObjectSide::Lateral;
  }

  /** Does a cell belong to the object, outside its box? */
  bool isOwnOutside(int c, int r) const
  {
    return context_.object.mask.contains(c, r) && !inside_.contains(c, r);
  }

  /** Depth of the object near one of its edges [m]; of the whole object where too little of it is
   * there. */
  double depthNear(BoxEdge edge) const
  {
    constexpr std::size_t kMinCells = 10;
    constexpr double kNearPart = 0.3;
    const auto quarter = cloud_.cellsOf(quarterInside(box_, edge));
    const auto& cells = context_.object.cells;
    std::vector<double> depths;
    for (std::size_t i = 0; i < cells.size(); i += sampleStep(cells.size()))
      if (quarter.contains(cells[i].c, cells[i].r))
        depths.push_back(cloud_.depth(cells[i].c, cells[i].r));
    return depths.size() < kMinCells ? context_.depth : quantile(std::move(depths), kNearPart);
  }

  /** Of a point at a depth that may lie on a supporting surface [m]. */
  double onSupport(double depth) const { return 0.03 + 2.0 * options_.depthSigma(depth); }

  bool isOnSupport(int c, int r) const
  {
    const double tolerance = onSupport(cloud_.depth(c, r));
    const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
    return std::any_of(
        context_.surfaces.begin(), context_.surfaces.end(),
        [&](const Plane& surface) { return std::abs(surface.signedDistance(p)) < tolerance; });
  }

  /** Of the lowest part that is seen of the object, above the camera [m]; it is not empty. */
  double lowestHeight() const
  {
    const auto& points = context_.object.points;
    std::vector<double> heights;
    for (std::size_t i = 0; i < points.size(); i += sampleStep(points.size()))
      heights.push_back(context_.up.dot(points[i]));
    return quantile(std::move(heights), kLowestPart);
  }

  /** Does a cell hide only what is lower than the object? Its ray descends from there, so what
   * hides the object's lower end from above rises above the lowest that is seen of it, by as much
   * more as it is nearer. A surface that does not, such as the desk before a screen's foot, leads
   * up to the object, whether or not it was found to be a plane. */
  bool hidesOnlyBelow(int c, int r) const
  {
    const double height = context_.up.dot(cloud_.point(c, r).cast<double>());
    return lowest_ && height < 0 && height < *lowest_ + onSupport(cloud_.depth(c, r));
  }

  /** What may be taken for the object's own depth, or for that of what touches it [m]. The depth of
   * an object without a cloud of its own is that of its surroundings. */
  double depthMargin(double depth) const
  {
    constexpr double kShareWithoutCloud = 0.25;
    return 0.05 + 3.0 * options_.depthSigma(depth) +
           (context_.object.empty() ? kShareWithoutCloud * depth : 0.0);
  }

  /** Is something at this cell nearer than `limit` [m]? A cell without depth is as near as the
   * screen that it lies on; elsewhere it lies in the shadow of a depth edge and tells nothing. */
  bool isNearer(int c, int r, double limit) const
  {
    if (cloud_.valid(c, r))
      return cloud_.depth(c, r) < limit && !isOwnOutside(c, r) && !isOnSupport(c, r) &&
             !hidesOnlyBelow(c, r);
    return std::any_of(
        screens_.begin(), screens_.end(),
        [&](const auto& screen) { return screen.depth < limit && screen.cells.contains(c, r); });
  }

  /** Share of an edge's length along which `isIt(c, r)` for a cell of the strip outside it. */
  template <typename IsIt>
  double shareAlong(BoxEdge edge, double width, const IsIt& isIt) const
  {
    const auto strip = cloud_.cellsOf(stripOutside(box_, edge, width));
    const bool upright = isUpright(edge);
    const int first = upright ? strip.r0 : strip.c0, last = upright ? strip.r1 : strip.c1;
    const int inner0 = upright ? strip.c0 : strip.r0, inner1 = upright ? strip.c1 : strip.r1;
    int count = 0;
    for (int i = first; i < last; ++i)
      for (int j = inner0; j < inner1; ++j)
        if (upright ? isIt(j, i) : isIt(i, j))
        {
          ++count;
          break;
        }
    return last > first ? static_cast<double>(count) / (last - first) : 0.0;
  }

  /** Share of the edge along which something nearer than the object stands outside it. */
  double nearerShare(BoxEdge edge, double depth) const
  {
    if (depth <= 0) return 0;
    const double limit = depth - depthMargin(depth);
    return shareAlong(
        edge, scaledPixels(cloud_, options_.occlusionStrip),
        [&](int c, int r) { return isNearer(c, r, limit); });
  }

  /** Share of the object's cells at one of its ends that something nearer touches. What stands
   * before another part of the edge hides nothing there. */
  double nearerShareAtEnd(BoxEdge edge) const
  {
    const bool upright = isUpright(edge);
    const int outwards = edge == BoxEdge::Left || edge == BoxEdge::Top ? -1 : 1;
    constexpr int kNone = std::numeric_limits<int>::min() / 2;
    // Of the object in each row (left, right) or column, outwards.
    std::vector<int> ends(
        static_cast<std::size_t>(upright ? cloud_.rows() : cloud_.columns()), kNone);
    int end = kNone;
    for (const auto& [c, r] : context_.object.cells)
    {
      int& last = ends[static_cast<std::size_t>(upright ? r : c)];
      last = std::max(last, outwards * (upright ? c : r));
      end = std::max(end, last);
    }
    const double tolerance = options_.edgeToleranceIn(cloud_.camera().width) / cloud_.stride();
    int cells = 0, touched = 0;
    for (std::size_t line = 0; line < ends.size(); ++line)
      if (ends[line] != kNone && end - ends[line] <= tolerance)
      {
        ++cells;
        touched += isNearerBeyond(upright, static_cast<int>(line), ends[line], outwards) ? 1 : 0;
      }
    return cells > 0 ? static_cast<double>(touched) / cells : 0.0;
  }

  /** Is something nearer in the strip beyond a cell of the object?
   * \param line Row (left and right edges) or column of the cell.
   * \param position Its column or row, times `outwards`, which is 1 or -1. */
  bool isNearerBeyond(bool upright, int line, int position, int outwards) const
  {
    const auto cell = [&](int p) {
      return upright ? ObjectCloud::Cell{p * outwards, line}
                     : ObjectCloud::Cell{line, p * outwards};
    };
    const auto own = cell(position);
    const double depth = cloud_.depth(own.c, own.r);
    const double limit = depth - depthMargin(depth);
    const int width = std::max(
        2, static_cast<int>(scaledPixels(cloud_, options_.occlusionStrip)) / cloud_.stride());
    for (int k = 1; k <= width; ++k)
    {
      const auto [c, r] = cell(position + k);
      if (cloud_.inside(c, r) && isNearer(c, r, limit)) return true;
    }
    return false;
  }

  /** Near the border of the image, and the object is not seen to end before it. */
  bool isNearBorder(BoxEdge edge, double depth) const
  {
    const double distance = distanceToBorder(cloud_.camera(), box_, edge);
    const double margin = options_.borderMarginIn(cloud_.camera().width);
    if (margin == 0 || distance >= margin) return false;
    return depth <= 0 || distance < scaledPixels(cloud_, kMinStrip_px) ||
           !endsBefore(edge, distance, depth);
  }

  /** Is there background, and nothing of the object's depth, between an edge and the border? */
  bool endsBefore(BoxEdge edge, double distance, double depth) const
  {
    constexpr double kMinBackground = 0.6, kMaxRest = 0.05;
    const double margin = depthMargin(depth);
    // Boxes are not exact: the object may reach a little beyond its edge.
    const auto near = cloud_.cellsOf(stripOutside(box_, edge, 0.5 * distance));
    const auto isBackground = [&](int c, int r) { return cloud_.depth(c, r) > depth + margin; };
    const auto isObject = [&](int c, int r) {
      return cloud_.valid(c, r) && !isBackground(c, r) && !isOnSupport(c, r) &&
             !near.contains(c, r);
    };
    return shareAlong(edge, distance, isBackground) >= kMinBackground &&
           shareAlong(edge, distance, isObject) <= kMaxRest;
  }

  HiddenEvidence evidence(BoxEdge edge) const
  {
    const auto i = static_cast<std::size_t>(edge);
    HiddenEvidence e;
    e.nearer = nearer_[i];
    e.touching = touching_[i];
    e.touchingBeside = std::max(touching_[(i + 1) % 4], touching_[(i + 3) % 4]);
    e.opposite = nearer_[(i + 2) % 4];
    e.depth = context_.depth;
    e.cutBeside = nearBorder_[(i + 1) % 4] || nearBorder_[(i + 3) % 4];
    for (std::size_t k = 0; k < 4; ++k)
      e.anyContact = e.anyContact || nearBorder_[k] || nearer_[k] > kContactShare;
    addSizes(e);
    e.floating = floating_;
    return e;
  }

  /** How the box compares with the label's typical size at the object's depth. */
  void addSizes(HiddenEvidence& e) const
  {
    const LabelProperties& label = context_.label;
    if (!label.known || context_.depth <= 0) return;
    const auto& camera = cloud_.camera();
    double width = box_.width() * context_.depth / std::abs(camera.fx);  // [m]
    double height = box_.height() * context_.depth / std::abs(camera.fy);
    if (std::abs(context_.up.x()) > std::abs(context_.up.y())) std::swap(width, height);
    const double lower = std::log(label.typicalSize.z() / height) / label.sizeSpread;
    e.tooLow = std::max(0.0, lower);
    e.tooNarrow =
        std::max(0.0, std::log(label.typicalSize.head<2>().maxCoeff() / width) / label.sizeSpread);
  }

  /** Share of the object's height by which its lower end is above the support, in [0, 1]. */
  double floating() const
  {
    if (!context_.object.support || context_.object.empty()) return 0;
    const Plane& support = context_.surfaces.front();
    const auto& points = context_.object.points;
    std::vector<double> heights;
    for (std::size_t i = 0; i < points.size(); i += sampleStep(points.size()))
      heights.push_back(support.signedDistance(points[i]));
    const auto [low, top] = quantileRange(std::move(heights), kLowestPart);
    // As much above the support was cut away with it.
    const double gap = low - onSupport(context_.depth);
    return top > 0 ? std::clamp(gap / top, 0.0, 1.0) : 0.0;
  }

  struct CellsAtDepth
  {
    DepthCloud::CellRange cells;
    double depth;  // [m]
  };

  const DepthCloud& cloud_;
  const ImageBox box_;
  const EdgeContext& context_;
  const PerceptionOptions& options_;
  const DepthCloud::CellRange inside_;  // cells of the box
  std::vector<CellsAtDepth> screens_;
  std::array<bool, 4> nearBorder_;
  std::array<double, 4> nearer_, touching_;
  std::optional<double> lowest_;  // height of the object's lower end [m]
  double floating_ = 0;
};

}  // namespace

std::array<EdgeMeasurement, 4> measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options)
{
  const EdgeJudge judge(cloud, box, context, options);
  auto out = edgesWithoutDepth(cloud.camera(), box, options);
  for (std::size_t i = 0; i < out.size(); ++i) out[i].state = judge.state(static_cast<BoxEdge>(i));
  return out;
}

}  // namespace quadmap
