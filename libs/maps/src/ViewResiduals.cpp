#include <algorithm>
#include <cmath>

#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap
{
namespace
{
/** What all residuals need of a state. */
struct UprightShape
{
  explicit UprightShape(const UprightState& x) :
      center(x.head<3>()),
      cosine(std::cos(x[3])),
      sine(std::sin(x[3])),
      semiAxes(x.tail<3>().array().exp())
  {
  }
  Eigen::Vector3d center;
  double cosine, sine;  // of the yaw
  Eigen::Vector3d semiAxes;
};

/** Half width of the upright object along n, with its derivatives by (yaw, ln a, ln b, ln c). */
struct HalfWidth
{
  double h = 0;
  Eigen::Vector4d d = Eigen::Vector4d::Zero();
};

HalfWidth halfWidth(const UprightShape& object, const Eigen::Vector3d& n, double q)
{
  const double c = object.cosine, s = object.sine;
  const Eigen::Vector3d n_obj(c * n.x() + s * n.y(), -s * n.x() + c * n.y(), n.z());
  const auto support = supportWithDerivatives(n_obj, object.semiAxes, q);

  HalfWidth w;
  w.h = support.h;
  w.d[0] = support.d_n.x() * n_obj.y() - support.d_n.y() * n_obj.x();
  w.d.tail<3>() = support.d_s.cwiseProduct(object.semiAxes);
  return w;
}

/** r = n.(c_face - t) - h_q(n), q = 2 with a heading: positive when the object is smaller than the
 * face says [m]. \param n The face's outward normal. */
double faceGap(
    const ObjectView& view,
    std::size_t face,
    const Eigen::Vector3d& n,
    const UprightShape& object,
    HalfWidth& width)
{
  width = halfWidth(object, n, view.faceExponent);
  return view.faceOffset(face, n) - n.dot(object.center) - width.h;
}

void addFaces(
    const ObjectView& view,
    const UprightShape& object,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq)
{
  const auto normals = view.faceNormals();
  for (std::size_t f = 0; f < kFaces; ++f)
  {
    const auto& face = view.faces[f];
    if (face.kind == FaceKind::Unknown) continue;
    HalfWidth width;
    const double gap = faceGap(view, f, normals[f], object, width);
    if (face.kind == FaceKind::AtLeast && gap <= 0) continue;  // large enough: nothing to say
    UprightState J;
    J << -normals[f], -width.d;
    if (face.kind == FaceKind::AtLeast)
      eq.addCauchy(gap / face.sigma, J / face.sigma, options.huber, weight);
    else
      eq.add(gap / face.sigma, J / face.sigma, options.huber, weight);
  }
}

/** r = (n.t + d) - h_q(n). */
void addEdges(
    const ObjectView& view,
    const UprightShape& object,
    double shapeExponent,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq)
{
  for (const auto& edge : view.edges)
  {
    const HalfWidth width = halfWidth(object, edge.plane.n, shapeExponent);
    const double sigma = edgeSigma(view, edge, options);
    UprightState J;
    J << edge.plane.n, -width.d;
    const double gap = edge.plane.signedDistance(object.center) - width.h;
    eq.add(gap / sigma, J / sigma, options.huber, weight);
  }
}

}  // namespace

void NormalEquations::add(
    double residual, const UprightState& jacobian, double huber, double weight)
{
  const double r = std::abs(residual);
  cost += weight * (r <= huber ? 0.5 * r * r : huber * r - 0.5 * huber * huber);
  const double w = weight * huberWeight(residual, huber);
  H.noalias() += w * jacobian * jacobian.transpose();
  g.noalias() += w * residual * jacobian;
}

void NormalEquations::addCauchy(
    double residual, const UprightState& jacobian, double scale, double weight)
{
  const double u = residual * residual / (scale * scale);
  cost += 0.5 * weight * scale * scale * std::log1p(u);
  const double w = weight / (1 + u);
  H.noalias() += w * jacobian * jacobian.transpose();
  g.noalias() += w * residual * jacobian;
}

double edgeSigma(
    const ObjectView& view, const ObjectView::Edge& edge, const EstimatorOptions& options)
{
  return (view.center - view.camera).norm() * edge.angle + view.positionSigma + options.edgeFloor +
         options.edgeShapeShare * view.halfSizes.mean();
}

Eigen::Matrix3d seedWhitening(const Eigen::Matrix3d& covariance, const EstimatorOptions& options)
{
  return std::sqrt(options.seedWeight) *
         covariance.llt().matrixL().solve(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

void addViewResiduals(
    const ObjectView& view,
    const UprightState& x,
    double shapeExponent,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq)
{
  const UprightShape object(x);
  if (view.complete) addFaces(view, object, options, weight, eq);
  if (view.complete && view.yawDefined)
  {
    UprightState J = UprightState::Zero();
    J[3] = 1.0 / view.yawSigma;
    const double yaw = nearestEquivalentYaw(view.yaw, x[3]);
    eq.add((x[3] - yaw) / view.yawSigma, J, options.huber, weight);
  }
  if (!view.complete || (options.edgesOfComplete && !view.allSidesKnown()))
    addEdges(view, object, shapeExponent, options, weight, eq);
  if (!view.complete)
  {
    // Where the depth says the object is: keeps it on the ray's right stretch until there is
    // parallax.
    const Eigen::Matrix3d whitening = seedWhitening(view.centerCovariance, options);
    const Eigen::Vector3d r = whitening * (x.head<3>() - view.center);
    for (Eigen::Index i = 0; i < 3; ++i)
    {
      UprightState J = UprightState::Zero();
      J.head<3>() = whitening.row(i);
      eq.add(r[i], J, options.huber, weight);
    }
  }
}

double viewWeight(const ObjectView& view, const UprightState& reference)
{
  const Eigen::Vector3d size = 2.0 * reference.tail<3>().array().exp();
  const double scale = 0.04 + 0.15 * size.mean();  // [m], what an honest measurement may be off by
  double squares = 0, count = 0;
  if (view.complete)
  {
    const UprightShape object(reference);
    const auto normals = view.faceNormals();
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      if (view.faces[f].kind == FaceKind::Unknown) continue;
      HalfWidth width;
      const double gap = faceGap(view, f, normals[f], object, width);
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
  if (count == 0) return 1.0;
  const double ratio = std::sqrt(squares / count) / scale;
  return 1.0 / (1.0 + std::pow(ratio, 4));
}

}  // namespace quadmap
