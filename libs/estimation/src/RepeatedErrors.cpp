#include "quadmap/estimation/RepeatedErrors.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
using Eigen::Vector3d;

namespace
{
/** Sides of a box in the image follow those of the object. */
constexpr int kYaw = kFaces, kFirstEdge = kYaw + 1;

/** Face 0..5 of an upright object that looks out along a direction. */
int sideAlong(const ObjectShape& object, const Vector3d& outward)
{
  const Vector3d along = object.R.transpose() * outward;
  Eigen::Index axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<int>(axis) + (along[axis] < 0 ? 1 : 0);
}

int sideOf(const BoxMeasurement::Edge& edge) { return kFirstEdge + static_cast<int>(edge.side); }

/** Where a camera is as seen from the object: the direction, and the logarithm of the distance. A
 * small move is as long as its angle. */
Eigen::Vector4d placeOf(const Vector3d& camera, const Vector3d& center)
{
  constexpr double kNearest = 0.1;  // [m]
  const Vector3d from = camera - center;
  const double range = std::max(kNearest, from.norm());
  Eigen::Vector4d place;
  place << from / range, std::log(range);
  return place;
}

double shareOf(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const EstimatorOptions& options)
{
  return options.repeatedAnywhere + (options.repeatedThere - options.repeatedAnywhere) *
                                        std::exp(-(a - b).norm() / options.repeatedAngle);
}

constexpr double kOneView = 0.5;  // weight of a view that is more likely right than wrong

/** E[(x - a)^2] of a standard normal variable x that is at least a. */
double squareBeyond(double a)
{
  const double tail = 0.5 * std::erfc(a / std::sqrt(2.0));
  constexpr double kFar = 8;  // the density decays like an exponential there
  if (a > kFar) return 2 / (a * a);
  const double density = std::exp(-0.5 * a * a) / std::sqrt(2 * M_PI);
  return 1 + a * a - a * density / tail;
}
}  // namespace

double repeatedShare(
    const Vector3d& a, const Vector3d& b, const Vector3d& center, const EstimatorOptions& options)
{
  return shareOf(placeOf(a, center), placeOf(b, center), options);
}

void shareEdgeErrors(std::vector<BoxMeasurement>& views)
{
  std::map<BoxSide, double> count;
  for (const auto& view : views)
    for (const auto& edge : view.edges) count[edge.side] += view.weight;
  for (auto& view : views)
    for (auto& edge : view.edges)
    {
      const double n = std::max(1.0, count[edge.side]);
      edge.sigma = std::hypot(edge.sigma, std::sqrt(n - 1) * edge.shared);
      edge.shared *= std::sqrt(n);
    }
}

RepeatedErrors::RepeatedErrors(
    const UprightState& state, double shapeExponent, const EstimatorOptions& options, bool fade) :
    object_(state), shapeExponent_(shapeExponent), options_(options), kernels_{options.huber, fade}
{
}

void RepeatedErrors::add(
    const ObjectView& view, const BoxMeasurement& measurement, const ViewAtPose& placed)
{
  const double range = (view.center - view.camera).norm();
  const double common = std::hypot(view.pose.position, range * view.pose.angle);
  const auto place = placeOf(view.camera, object_.t);
  const double weight = measurement.weight;
  if (view.complete) addFaces(view, weight, common, place, placed);
  if (view.complete && view.yawDefined)
  {
    const ResidualRow row = placed.yaw(object_);
    const Sigmas sigmas{view.yawSigma, view.pose.angle};
    addRow(row, sigmas, RobustKernel::huber(kernels_.threshold), weight, place, sides_[kYaw]);
    sides_[kYaw].found += weight * (row.r * row.r - sigmas.common * sigmas.common);
    sides_[kYaw].claimed += weight * sigmas.own2();
  }
  for (const auto& edge : measurement.edges)
  {
    Side& side = sides_[sideOf(edge)];
    const ResidualRow row = placed.edge(edge, object_, shapeExponent_);
    const Sigmas sigmas{edge.sigma, std::hypot(common, edge.shared)};
    addRow(row, sigmas, kernels_.ofEdge(), weight, place, side);
  }
}

void RepeatedErrors::addFaces(
    const ObjectView& view,
    double weight,
    double common,
    const Eigen::Vector4d& place,
    const ViewAtPose& placed)
{
  constexpr double kContradicts = 3;  // [sigmas]
  const auto normals = view.faceNormals();
  for (std::size_t f = 0; f < kFaces; ++f)
  {
    const auto& face = view.faces[f];
    if (face.kind == FaceKind::Unknown) continue;
    const ResidualRow row = placed.face(f, object_);
    const RobustKernel kernel = kernels_.ofFace(face.kind);
    const double fromCamera = view.faceOffset(f) - normals[f].dot(view.camera);  // along the normal
    const double w = weight * kernel.weight(row.r / face.sigma) / (face.sigma * face.sigma);
    byDepth_ += w * fromCamera * row.byUprightState();
    Side& side = sides_[sideAlong(object_, normals[f])];
    if (std::abs(row.r) <= kContradicts * face.sigma)
      (view.isCutByImage[f] ? side.cut : side.ends) += weight;
    // Supports are surfaces of the room, which many frames have measured already.
    if (face.kind == FaceKind::Support) continue;
    addRow(row, {face.sigma, common}, kernel, weight, place, side);
    side.weights += weight;
    if (face.kind == FaceKind::AtLeast && row.r > kContradicts * face.sigma)
      side.squaredGaps += weight * row.r * row.r;
  }
}

void RepeatedErrors::addRow(
    const ResidualRow& row,
    const Sigmas& sigmas,
    const RobustKernel& kernel,
    double weight,
    const Eigen::Vector4d& place,
    Side& side)
{
  const double w = weight * kernel.weight(row.r / sigmas.all), own = std::sqrt(sigmas.own2());
  if (w <= 0 || own <= 0) return;
  side.rows.push_back(
      {place, row.byUprightState() * (std::sqrt(w) * own / (sigmas.all * sigmas.all))});
}

double RepeatedErrors::Sigmas::own2() const { return std::max(0.0, all * all - common * common); }

double RepeatedErrors::Side::excess() const
{
  return claimed > 0 ? std::max(1.0, found / claimed) : 1.0;  // (11.23)
}

UprightCovariance RepeatedErrors::crossTerms() const
{
  UprightCovariance X = UprightCovariance::Zero();
  for (const auto& [name, side] : sides_)
    for (std::size_t i = 0; i < side.rows.size(); ++i)
    {
      UprightState others = UprightState::Zero();
      for (std::size_t j = 0; j < i; ++j)
        others +=
            shareOf(side.rows[i].place, side.rows[j].place, options_) * side.rows[j].influence;
      const UprightCovariance cross = side.excess() * side.rows[i].influence * others.transpose();
      X += cross + cross.transpose();
    }
  const double sigma = options_.depthScaleSigma;
  return X + sigma * sigma * byDepth_ * byDepth_.transpose();  // (11.24)
}

/** How the state changes by a metre of one of its sides alone. */
UprightState RepeatedErrors::moveOfSide(std::size_t face) const
{
  const auto axis = static_cast<Eigen::Index>(face / 2);
  UprightState move = UprightState::Zero();
  move.head<3>() = (face % 2 == 0 ? 0.5 : -0.5) * object_.R.col(axis);
  move[4 + axis] = 0.5 / object_.s[axis];
  return move;
}

UprightCovariance RepeatedErrors::contradictions() const
{
  UprightCovariance P = UprightCovariance::Zero();
  for (std::size_t f = 0; f < kFaces; ++f)
  {
    const auto side = sides_.find(static_cast<int>(f));
    if (side == sides_.end() || side->second.squaredGaps <= 0) continue;
    const UprightState move = moveOfSide(f);
    P += side->second.squaredGaps / side->second.weights * move * move.transpose();
  }
  return P;
}

UprightCovariance RepeatedErrors::openEnds(const LabelProperties& label) const
{
  const auto prior = labelPriorRows(object_.s.array().log(), label, options_);
  UprightCovariance P = UprightCovariance::Zero();
  for (std::size_t f = 0; f < kFaces; ++f)
  {
    const auto side = sides_.find(static_cast<int>(f));
    if (side == sides_.end() || side->second.cut <= 0 || side->second.ends >= kOneView) continue;
    const auto axis = static_cast<Eigen::Index>(f / 2);
    const double spread = 1 / prior[f / 2].d_logSizes[axis];
    const double beyond =
        2 * object_.s[axis] * spread * std::sqrt(squareBeyond(prior[f / 2].r));  // [m]
    const UprightState move = moveOfSide(f);
    P += beyond * beyond * move * move.transpose();
  }
  return P;
}

}  // namespace quadmap
