#include "edges/EdgeMeasurements.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "edges/EdgeStrips.h"
#include "edges/ObjectEnd.h"
#include "edges/Occluders.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/perception/BoxEdges.h"
#include "quadmap/surfaces/SurfaceTolerance.h"
#include "support/UnseenFoot.h"

namespace quadmap
{
namespace
{
/** The object is in contact with something nearer that stands along more of an edge than this
 * share. */
constexpr double kContactShare = 0.1;

/** An edge looks down when the direction out of the box over it does by 30 degrees or more. Of
 * turned cameras two edges do [sine]. */
constexpr double kLooksDown = 0.5;

/** Options in pixels are meant for images of this width, and grow with the image. */
double scaledPixels(const DepthCloud& cloud, double pixels)
{
  return PerceptionOptions::scaledPixels(pixels, cloud.camera().width);
}

/** Judges the edges of one box. */
class EdgeJudge
{
 public:
  EdgeJudge(
      const DepthCloud& cloud,
      const ImageBox& box,
      const EdgeContext& context,
      const PerceptionOptions& options) :
      cloud_(cloud),
      box_(box),
      context_(context),
      options_(options),
      occluders_(cloud, box, context, options)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto edge = static_cast<BoxEdge>(i);
      ends_.emplace_back(cloud, context, edge, options);
      depth_[i] = depthNear(edge);
      nearBorder_[i] = isCutByBorder(edge, depth_[i]);
      nearer_[i] = nearerShare(edge, depth_[i]);
    }
  }

  EdgeEvidence evidence(BoxEdge edge) const
  {
    const HiddenEvidence seen = hiddenEvidence(edge);
    return {sideOf(edge), seen, isNearBorder(edge) || isBeforeTheFoot(edge, seen)};
  }

  EdgeState state(BoxEdge edge, const EdgeEvidence& seen) const
  {
    if (isNearBorder(edge)) return EdgeState::NearImageBorder;
    const bool isHidden =
        seen.isRefused || hiddenProbability(seen.side, seen.hidden) > options_.maxHiddenProbability;
    return isHidden ? EdgeState::Occluded : EdgeState::Usable;
  }

 private:
  bool isNearBorder(BoxEdge edge) const { return nearBorder_[static_cast<std::size_t>(edge)]; }

  /** Is this a lower edge of a box that is too low to show the foot of its object? What leads up to
   * the object, as a table to a chair behind it, shows no jump in depth. A box that is cut above is
   * low for that reason. */
  bool isBeforeTheFoot(BoxEdge edge, const HiddenEvidence& seen) const
  {
    const bool isCutAbove = nearBorder_[(static_cast<std::size_t>(edge) + 2) % 4];
    return upwards(edge) < -kLooksDown && !isCutAbove &&
           isFootOutOfSight(context_.object, context_.label, seen.tooLow);
  }

  /** Cosine between up and the direction that looks out of the box over an edge. */
  double upwards(BoxEdge edge) const
  {
    return -boxEdgePlane(cloud_.camera(), box_, edge).n.dot(context_.up);
  }

  ObjectSide sideOf(BoxEdge edge) const
  {
    const Plane plane = boxEdgePlane(cloud_.camera(), box_, edge);
    return isUpperEdge(plane, context_.up)    ? ObjectSide::Top
           : isUpperEdge(plane, -context_.up) ? ObjectSide::Bottom
                                              : ObjectSide::Lateral;
  }

  /** Depth of the object near one of its edges [m]; of the whole object where too little of it is
   * there. */
  double depthNear(BoxEdge edge) const
  {
    constexpr double kNearPart = 0.3;
    const auto quarter = cloud_.cellsOf(quarterInside(box_, edge));
    const auto& cells = context_.object.cells;
    std::vector<double> depths;
    for (std::size_t i = 0; i < cells.size(); i += sampleStep(cells.size()))
      if (quarter.contains(cells[i].c, cells[i].r))
        depths.push_back(cloud_.depth(cells[i].c, cells[i].r));
    return depths.size() < kFewestCells ? context_.depth : quantile(std::move(depths), kNearPart);
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
    const double limit = depth - depthTolerance(depth, options_);
    return shareAlong(
        edge, scaledPixels(cloud_, options_.occlusionStrip),
        [&](int c, int r) { return occluders_.isNearer(c, r, limit); });
  }

  /** So near to the border of the image that the border may have cut the object. */
  bool isCutByBorder(BoxEdge edge, double depth) const
  {
    const auto& camera = cloud_.camera();
    const double distance = distanceToBorder(camera, box_, edge);
    const double margin = options_.borderMarginIn(camera.width);
    if (margin == 0 || distance >= margin) return false;
    const double sigma = options_.edgeSigmaIn(camera.width, sizeAcross(edge));
    return depth <= 0 || distance < kBeyondChance * sigma;
  }

  double sizeAcross(BoxEdge edge) const { return isUpright(edge) ? box_.width() : box_.height(); }

  HiddenEvidence hiddenEvidence(BoxEdge edge) const
  {
    const auto i = static_cast<std::size_t>(edge);
    HiddenEvidence e;
    e.nearer = nearer_[i];
    for (std::size_t k = 0; k < 4; ++k)
      e.anyContact = e.anyContact || nearBorder_[k] || nearer_[k] > kContactShare;
    e.endAtBorder = ends_[i].shareAtBorder();
    if (!context_.object.support) e.coverageUnsupported = context_.object.coverage;
    e.tooLow = tooLow();
    addCuboid(edge, e);
    return e;
  }

  /** How far the cuboid reaches beyond an edge, and whether it is the object's. */
  void addCuboid(BoxEdge edge, HiddenEvidence& e) const
  {
    const auto i = static_cast<std::size_t>(edge);
    const double pixel = scaledPixels(cloud_, 1);
    e.size_px = sizeAcross(edge) / pixel;
    e.length_px = (isUpright(edge) ? box_.height() : box_.width()) / pixel;
    e.cloudShort_px = ends_[i].shortOf(box_) / pixel;
    if (!context_.cuboidBox) return;
    const ImageBox& cuboid = *context_.cuboidBox;
    const double beyond[4] = {
        box_.x1 - cuboid.x1, box_.y1 - cuboid.y1, cuboid.x2 - box_.x2, cuboid.y2 - box_.y2};
    e.cuboidBeyond_px = beyond[i] / pixel;
    const auto& camera = cloud_.camera();
    e.cuboidFit = imageBoxIoU(cuboid.clipped(camera.width, camera.height), box_);
  }

  /** How much lower the box is than the label's typical size at the object's depth, equation (9.5).
   */
  double tooLow() const
  {
    const LabelProperties& label = context_.label;
    if (!label.known || context_.depth <= 0) return 0;
    const auto& camera = cloud_.camera();
    const bool isOnItsSide = std::abs(context_.up.x()) > std::abs(context_.up.y());
    const double height = context_.depth * (isOnItsSide ? box_.width() / std::abs(camera.fx)
                                                        : box_.height() / std::abs(camera.fy));
    return std::max(0.0, label.spreadsBetween(height, label.typicalSize.z()));
  }

  const DepthCloud& cloud_;
  const ImageBox box_;
  const EdgeContext& context_;
  const PerceptionOptions& options_;
  const Occluders occluders_;
  std::array<bool, 4> nearBorder_;
  std::array<double, 4> depth_;  // of the object near each edge [m]
  std::array<double, 4> nearer_;
  std::vector<ObjectEnd> ends_;
};

}  // namespace

JudgedEdges measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options)
{
  const EdgeJudge judge(cloud, box, context, options);
  JudgedEdges out{edgesWithoutDepth(cloud.camera(), box, options), {}};
  for (std::size_t i = 0; i < out.edges.size(); ++i)
  {
    const auto edge = static_cast<BoxEdge>(i);
    out.evidence[i] = judge.evidence(edge);
    out.edges[i].state = judge.state(edge, out.evidence[i]);
  }
  return out;
}

}  // namespace quadmap
