#include "cuboid/HeldUp.h"

#include <algorithm>
#include <cmath>

#include "cuboid/CuboidFit.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
/** How far an object reaches out of its box below, equation (8.12), and how well the edge of the
 * box is known there [m]. */
struct HeldUp::Overhang
{
  double reach = 0, sigma = 0;
};

HeldUp::HeldUp(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const LabelProperties& label,
    const PerceptionOptions& options) :
    estimator_(estimator),
    label_(label),
    options_(options),
    edges_(edgesWithoutDepth(camera, estimator.box(), options))
{
}

/** Over the edge that the bottom looks out over most; nothing when it tells nothing of it, as from
 * straight above. Over another edge a side may reach out. */
std::optional<HeldUp::Overhang> HeldUp::overhang(double bottom, const Faces& faces) const
{
  Faces cut = faces;
  cut[kBottom].position = bottom;
  const Ellipsoid object =
      cuboidOf(cut, estimator_.R_obj_optical()).transformed(T_sensor_optical());
  const Eigen::Matrix3d R = object.rotation();
  const EdgeMeasurement& edge = *std::max_element(
      edges_.begin(), edges_.end(),
      [&](const EdgeMeasurement& a, const EdgeMeasurement& b)
      { return a.plane_sensor.n.dot(R.col(2)) < b.plane_sensor.n.dot(R.col(2)); });
  const Plane& plane = edge.plane_sensor;
  if (edge.state != EdgeState::Usable || !looksOver(plane, -R.col(2))) return {};
  const Eigen::Vector3d n_obj = R.transpose() * plane.n;
  const double h = supportFunction<double>(n_obj, object.semiAxes(), label_.shapeExponent);
  return Overhang{h - plane.signedDistance(object.center()), estimator_.range() * edge.sigmaAngle};
}

/** The bottom with which the object ends where its box does, in its lower half. \param from A
 * bottom with which it reaches out. */
std::optional<double> HeldUp::bottomInBox(double from, const Faces& faces) const
{
  constexpr int kHalvings = 20;  // to a millionth of the height
  double reachesOut = from, isInside = 0.5 * (from - faces[kTop].position);
  if (overhang(isInside, faces)->reach > 0) return {};
  for (int i = 0; i < kHalvings; ++i)
  {
    const double middle = 0.5 * (reachesOut + isInside);
    (overhang(middle, faces)->reach > 0 ? reachesOut : isInside) = middle;
  }
  return isInside;
}

std::optional<double> HeldUp::bottomOf(const Faces& faces) const
{
  constexpr double kContradicts = 3.0;  // standard deviations: by chance one edge in 700
  if (faces[kBottom].worth.kind != FaceKind::Support || label_.support == UsualSupport::Floor)
    return {};
  const double support = faces[kBottom].position;
  const auto ofSupport = overhang(support, faces);
  const FaceEstimate end = estimator_.endInBox();
  if (!ofSupport || end.isCut) return {};
  const double clear = clearOfSupport(estimator_.range(), label_, options_);
  std::optional<double> bottom;
  if (support - end.position >= clear)
  {
    if (std::abs(overhang(end.position, faces)->reach) >= std::abs(ofSupport->reach)) return {};
    bottom = end.position;
  }
  // A box is a rectangle, and of a screen seen at an angle it shows some of the foot as well.
  const double from = bottom.value_or(support);
  if (overhang(from, faces)->reach > kContradicts * ofSupport->sigma)
    if (const auto inBox = bottomInBox(from, faces)) bottom = inBox;
  if (!bottom) return {};
  // What mostly goes on below its box, and is not clear of the support, stands: the box is wrong.
  return estimator_.shareOfLinesBelow(support - clear) < 0.5 ? bottom : std::nullopt;
}

FaceEstimate HeldUp::bottomAt(double position, const Faces& faces) const
{
  FaceEstimate bottom;
  bottom.position = position;
  // What shows at the lower edge of the box may be what holds the object up.
  if (const auto left = overhang(position, faces))
    bottom.worth = {FaceKind::Measured, std::hypot(left->sigma, left->reach)};
  return bottom;
}

ObjectCloud partAbove(double bottom, const Eigen::Vector3d& up, const ObjectCloud& object)
{
  ObjectCloud part = object;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < object.points.size(); ++i)
    if (-up.dot(object.points[i]) <= bottom)
    {
      part.points[kept] = object.points[i];
      part.cells[kept++] = object.cells[i];
    }
  part.points.resize(kept);
  part.cells.resize(kept);
  return part;
}

}  // namespace quadmap
