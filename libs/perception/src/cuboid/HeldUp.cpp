#include "cuboid/HeldUp.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "cuboid/CuboidFit.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/perception/BoxEdges.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
HeldUp::HeldUp(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const LabelProperties& label,
    const PerceptionOptions& options) :
    estimator_(estimator), label_(label), options_(options)
{
  const Eigen::Matrix3d R_obj_sensor =
      estimator.R_obj_optical() * T_sensor_optical().getRotationMatrix().asEigen().transpose();
  const Eigen::Vector3d up_sensor = R_obj_sensor.row(2);
  const auto edges = edgesWithoutDepth(camera, estimator.box(), options);
  const auto lowest = std::max_element(
      edges.begin(), edges.end(),
      [&](const EdgeMeasurement& a, const EdgeMeasurement& b)
      { return a.plane_sensor.n.dot(up_sensor) < b.plane_sensor.n.dot(up_sensor); });
  const Plane& edge = lowest->plane_sensor;
  if (lowest->state != EdgeState::Usable || !looksOver(edge, -up_sensor)) return;
  edge_obj_ = Plane{R_obj_sensor * edge.n, edge.d};
  edgeSigma_ = estimator.range() * lowest->sigmaAngle;
}

/** How far an object with this bottom reaches out of its box below [m], equation (8.12). */
double HeldUp::overhang(double bottom, const Faces& faces) const
{
  Faces cut = faces;
  cut[kBottom].position = bottom;
  const Ellipsoid object_obj = cuboidOf(cut, Eigen::Matrix3d::Identity());
  return supportFunction<double>(edge_obj_->n, object_obj.semiAxes(), label_.shapeExponent) -
         edge_obj_->signedDistance(object_obj.center());
}

/** The bottom with which the object ends where its box does, in its lower half. \param from A
 * bottom with which it reaches out. */
std::optional<double> HeldUp::bottomInBox(double from, const Faces& faces) const
{
  constexpr int kHalvings = 20;  // to a millionth of the height
  double outside = from, inside = 0.5 * (from - faces[kTop].position);
  if (overhang(inside, faces) > 0) return {};
  for (int i = 0; i < kHalvings; ++i)
  {
    const double middle = 0.5 * (outside + inside);
    (overhang(middle, faces) > 0 ? outside : inside) = middle;
  }
  return inside;
}

std::optional<double> HeldUp::bottomOf(const Faces& faces) const
{
  if (faces[kBottom].worth.kind != FaceKind::Support || label_.support == UsualSupport::Floor)
    return {};
  const FaceEstimate end = estimator_.endInBox();
  if (!edge_obj_ || end.isCut) return {};
  const double support = faces[kBottom].position;
  const double clear = clearOfSupport(estimator_.range(), label_, options_);
  std::optional<double> bottom;
  if (support - end.position >= clear)
  {
    if (std::abs(overhang(end.position, faces)) >= std::abs(overhang(support, faces))) return {};
    bottom = end.position;
  }
  // A box is a rectangle, and of a screen seen at an angle it shows some of the foot as well.
  const double from = bottom.value_or(support);
  if (overhang(from, faces) > kBeyondChance * edgeSigma_)
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
  if (edge_obj_)
    bottom.worth = {FaceKind::Measured, std::hypot(edgeSigma_, overhang(position, faces))};
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
