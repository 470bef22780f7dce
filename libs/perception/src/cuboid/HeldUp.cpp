#include "cuboid/HeldUp.h"

#include <algorithm>
#include <cmath>

#include "cuboid/CuboidFit.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
/** How far an object ends from the edges of its box that its bottom looks out over [m], equation
 * (8.12). */
double distanceFromLowerEdges(
    const std::array<Plane, 4>& edges, const Ellipsoid& object, double shapeExponent)
{
  const Eigen::Matrix3d R = object.rotation();
  double distance = 0;
  for (const Plane& edge : edges)
    if (looksOver(edge, -R.col(2)))
    {
      const Eigen::Vector3d n_obj = R.transpose() * edge.n;
      const double h = supportFunction<double>(n_obj, object.semiAxes(), shapeExponent);
      distance = std::max(distance, std::abs(edge.signedDistance(object.center()) - h));
    }
  return distance;
}

}  // namespace

std::optional<FaceEstimate> heldUpBottom(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const Faces& standing,
    const LabelProperties& label,
    const PerceptionOptions& options)
{
  const FaceEstimate end = estimator.endInBox();
  const double gap = standing[kBottom].position - end.position;
  if (label.support == UsualSupport::Floor || end.isCut ||
      gap < clearOfSupport(estimator.range(), label, options))
    return {};
  Faces held = standing;
  held[kBottom] = end;
  const ImageBox& box = estimator.box();
  const auto edges = boxEdgePlanes(camera, box);
  const auto away = [&](const Faces& faces)
  {
    return distanceFromLowerEdges(
        edges, cuboidOf(faces, estimator.R_obj_optical()), label.shapeExponent);
  };
  const double disagreement = away(held);
  if (disagreement >= away(standing)) return {};  // from straight above no edge tells
  // What shows at the lower edge of the box may be what holds the object up.
  const double sigma_px = options.edgeSigmaIn(camera.width, box.height());
  const double ofEdge = estimator.range() * sigma_px / std::abs(camera.fy);
  held[kBottom].worth = {FaceKind::Measured, std::hypot(ofEdge, disagreement)};
  return held[kBottom];
}

}  // namespace quadmap
