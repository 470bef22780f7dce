#include "quadmap/estimation/ViewResiduals.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
void addViewResiduals(
    const ViewAtPose& view,
    const ObjectShape& object,
    double q,
    const RowKernels& kernels,
    double weight,
    NormalEquations& eq)
{
  view.forEachRow(
      object, q, kernels,
      [&](const ResidualRow& row, double sigma, const RobustKernel& kernel)
      { eq.add(row.r / sigma, row.byUprightState() / sigma, kernel, weight); });
}

void addViewResiduals(
    const ObjectView& view,
    const UprightState& x,
    double shapeExponent,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq)
{
  const BoxMeasurement measurement = measurementInMap(view, options);
  const ViewAtPose inMap(
      measurement, RobotPose(), ObjectFreedom::Upright, RowDerivatives::OfObject);
  addViewResiduals(inMap, ObjectShape(x), shapeExponent, {options.huber}, weight, eq);
}

namespace
{
/** How far the heading of a cuboid without any measured side moves the ends of the object [m]. Its
 * sides are bounds, and lie within the object when it is another thing's. Where a side was measured
 * it tells, and a heading may differ as the pose has drifted. */
double turnedBy(const ObjectView& view, const UprightState& reference)
{
  const auto end = view.faces.begin() + 4;
  const bool hasSide = std::any_of(
      view.faces.begin(), end, [](const FaceMeasurement& face) { return isEquality(face.kind); });
  if (!view.complete || !view.yawDefined || hasSide) return 0;
  const double half = std::exp(reference.segment<2>(4).maxCoeff());
  return half * (nearestEquivalentYaw(view.yaw, reference[3]) - reference[3]);
}
}  // namespace

double viewWeight(const ObjectView& view, const UprightState& reference)
{
  const Eigen::Vector3d size = 2.0 * reference.tail<3>().array().exp();
  const double scale = 0.04 + 0.15 * size.mean();  // [m], what an honest measurement may be off by
  double squares = 0, count = 0;
  if (view.complete)
  {
    const ObjectShape object(reference);
    const auto normals = view.faceNormals();
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      if (view.faces[f].kind == FaceKind::Unknown) continue;
      const Eigen::Vector3d inward = -normals[f];
      const double half = view.halfSizes[static_cast<Eigen::Index>(f / 2)];
      const double gap = faceRow(inward, object.t - view.center, half, object, view.faceExponent).r;
      if (view.faces[f].kind == FaceKind::AtLeast && gap <= 0) continue;
      squares += gap * gap;
      count += 1;
    }
  }
  else
  {
    const Eigen::Vector3d off = reference.head<3>() - view.center;
    squares = off.dot(view.centerCovariance.llt().solve(off)) * scale * scale / 4.0;
    count = 1;
  }
  const double gap = count == 0 ? 0.0 : std::sqrt(squares / count);
  const double ratio = std::hypot(gap, turnedBy(view, reference)) / scale;
  return 1.0 / (1.0 + std::pow(ratio, 4));  // (11.14)
}

}  // namespace quadmap
