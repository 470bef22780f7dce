#include "quadmap/estimation/ObjectRules.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "quadmap/estimation/Association.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/Support.h"

namespace quadmap
{
namespace
{
/** Log-likelihood of the sizes, doc/mathematics.md, (12.7). A size that is only a lower bound
 * counts when it is larger than the object's. */
double sizeTerm(const ObjectView& view, const MapObject& object, const AgreementOptions& options)
{
  if (!view.complete || object.completeCount == 0) return 0;
  const UprightState x = uprightStateOf(object.object);
  Eigen::Vector3d expected = x.tail<3>();
  if (quarterTurnsTo(view.yaw, x[3]) % 2 != 0) std::swap(expected[0], expected[1]);

  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<Eigen::Index>(axis);
    const double difference = std::log(view.halfSizes[i]) - expected[i];
    if (view.axisKnown(axis) || difference > 0) sum += difference * difference;
  }
  const double sigma2 = options.sizeLogSigma * options.sizeLogSigma;
  return -std::min(0.5 * sum / sigma2, options.maxSizePenalty);
}

/** Log-likelihood of the box in the image, doc/mathematics.md, (12.8). */
double imageTerm(
    const ImageBox& box,
    const Ellipsoid& object,
    const FrameGeometry& frame,
    double shapeExponent,
    const AgreementOptions& options)
{
  if (!box.isValid() || frame.camera.width == 0) return 0;
  const auto projected = projectedBox(object, frame, shapeExponent);
  const unsigned width = frame.camera.width, height = frame.camera.height;
  const double iou =
      projected ? imageBoxIoU(projected->clipped(width, height), box.clipped(width, height)) : 0.0;
  return options.imageWeight * std::log(std::max(iou, options.minImageIoU) / 0.5);
}

/** Log-density of a measured cuboid along one of its axes, doc/mathematics.md, (12.4) to (12.6).
 * \param offset Centre of the measurement minus that of the object [m].
 * \param objectHalf Half width of the object, \param variance of its position [m^2]. */
double axisLogLikelihood(
    const ObjectView& view, std::size_t axis, double offset, double objectHalf, double variance)
{
  const auto& plus = view.faces[2 * axis];
  const auto& minus = view.faces[2 * axis + 1];
  // How much further out the object would end than the measurement if they were concentric [m].
  const double larger = objectHalf - view.halfSizes[static_cast<Eigen::Index>(axis)];
  const auto logNormal = [](double x, double v)
  { return -0.5 * x * x / v - 0.5 * std::log(2 * M_PI * v); };

  if (view.axisKnown(axis))
    return logNormal(
        offset, variance + 0.25 * (std::pow(plus.sigma, 2) + std::pow(minus.sigma, 2)));
  if (isEquality(plus.kind)) return logNormal(offset - larger, variance + std::pow(plus.sigma, 2));
  if (isEquality(minus.kind))
    return logNormal(offset + larger, variance + std::pow(minus.sigma, 2));
  // A part without known ends lies anywhere inside. Its density is uniform there and has Gaussian
  // tails outside.
  const double inside = std::max(larger, 0.0);
  const double outside = std::max(0.0, std::abs(offset) - inside);
  const double v = variance + std::pow(plus.sigma, 2);
  return -0.5 * outside * outside / v - std::log(2 * inside + std::sqrt(2 * M_PI * v));
}

/** Half width of the ellipsoid along n [m], doc/mathematics.md, (3.1). */
double halfWidthAlong(const Ellipsoid& object, const Eigen::Vector3d& n)
{
  return supportFunction<double>(object.rotation().transpose() * n, object.semiAxes(), 2.0);
}

/** Covariance of a measured centre minus the object's, of which the last term is a share of its
 * size: S_ik - S_k of doc/mathematics.md, (12.3). */
Eigen::Matrix3d positionCovariance(const MapObject& object, const AgreementOptions& options)
{
  return object.covariance.topLeftCorner<3, 3>() +
         options.extentShare * options.extentShare * object.object.shapeMatrix();
}

/** Covariance of the place of a partial measurement whose depth is that of another thing. */
Eigen::Matrix3d wrongDepthCovariance(const ObjectView& view)
{
  const Eigen::Vector3d alongRay = view.wrongDepthSigma * (view.center - view.camera).normalized();
  return view.centerCovariance + alongRay * alongRay.transpose();
}

/** Log-likelihoods of a partial measurement's place, doc/mathematics.md, (12.11). */
struct DepthHypotheses
{
  double own;    //!< The depth is the object's
  double other;  //!< It is of what hides the object or stands behind it
};

DepthHypotheses depthHypotheses(
    const ObjectView& view, const MapObject& object, const AgreementOptions& options)
{
  const Eigen::Vector3d off = view.center - object.object.center();
  const Eigen::Matrix3d S_object = positionCovariance(object, options);
  return {
      std::log(1 - options.wrongDepthShare) + logGaussian(off, S_object + view.centerCovariance),
      std::log(options.wrongDepthShare) + logGaussian(off, S_object + wrongDepthCovariance(view))};
}

/** Do they show one thing? \param surer The detector's score of it is at least the other's. */
bool areTwins(
    const DetectedObject& surer,
    const DetectedObject& other,
    const LabelTable& labels,
    const AgreementOptions& options)
{
  if (surer.instanceId && other.instanceId && *surer.instanceId != *other.instanceId) return false;
  const double iou = imageBoxIoU(surer.box, other.box);
  if (iou > options.duplicateIoU) return true;
  if (iou <= options.confusedIoU || surer.score <= other.score) return false;
  const std::string a = labels.canonical(surer.label), b = labels.canonical(other.label);
  return a != b && labels.compatible(a, b);
}

}  // namespace

std::vector<bool> surestOfTwins(
    const std::vector<DetectedObject>& objects,
    const LabelTable& labels,
    const AgreementOptions& options)
{
  std::vector<std::size_t> bySureness(objects.size());
  std::iota(bySureness.begin(), bySureness.end(), 0);
  const auto sureness = [&](std::size_t k)  // files may hold scores that are no numbers
  { return std::isnan(objects[k].score) ? -1.0 : objects[k].score; };
  std::stable_sort(
      bySureness.begin(), bySureness.end(),
      [&](std::size_t a, std::size_t b) { return sureness(a) > sureness(b); });
  std::vector<bool> stays(objects.size(), false);
  // What goes itself takes nothing with it: in a row each may overlap the next.
  for (const std::size_t k : bySureness)
    stays[k] = std::none_of(
        bySureness.begin(), bySureness.end(),
        [&](std::size_t j)
        { return stays[j] && areTwins(objects[j], objects[k], labels, options); });
  return stays;
}

double labelAgreement(const MapObject& object, const std::string& label, const LabelTable& labels)
{
  double fitting = 0, total = 0;
  for (const auto& [name, count] : object.labelCounts)
  {
    total += count;
    if (labels.compatible(name, label)) fitting += count;
  }
  return total > 0 ? fitting / total : 0.0;
}

double labelAgreement(const MapObject& a, const MapObject& b, const LabelTable& labels)
{
  double fitting = 0, total = 0;
  for (const auto& [name, count] : a.labelCounts)
  {
    total += count;
    fitting += count * labelAgreement(b, name, labels);
  }
  return total > 0 ? fitting / total : 0.0;
}

bool areOneObject(
    const MapObject& a, const MapObject& b, const LabelTable& labels, const MergeOptions& options)
{
  const double distance = (a.object.center() - b.object.center()).norm();
  if (distance > a.object.semiAxes().norm() + b.object.semiAxes().norm()) return false;
  const double volumeA = a.object.cuboidVolume(), volumeB = b.object.cuboidVolume();
  const double shared = cuboidIntersectionVolume(a.object, b.object);
  if (shared > options.anyLabelIoU * (volumeA + volumeB - shared)) return true;

  // Thin things whose yaw is uncertain hardly overlap, for example a TV that is seen as boxes only.
  // How far the ellipsoids penetrate along the line between the centres (13.5) tells more.
  const Eigen::Vector3d n = (a.object.center() - b.object.center()) / std::max(distance, 1e-9);
  const bool penetrating =
      distance < options.penetration * (halfWidthAlong(a.object, n) + halfWidthAlong(b.object, n));
  if (!penetrating && shared <= options.overlap * std::min(volumeA, volumeB)) return false;
  return labelAgreement(a, b, labels) >= options.minLabelAgreement;
}

double labelLogLikelihood(double agreement, const AgreementOptions& options)
{
  return -options.labelPenalty * (1.0 - agreement);  // (12.9)
}

double agreementLogLikelihood(
    const ObjectView& view,
    const ImageBox& box,
    const MapObject& object,
    const FrameGeometry& frame,
    const LabelTable& labels,
    const AgreementOptions& options)
{
  const double shapeExponent = labels.properties(object.label()).shapeExponent;
  return sizeTerm(view, object, options) +
         imageTerm(box, object.object, frame, shapeExponent, options) +
         labelLogLikelihood(labelAgreement(object, view.label, labels), options);
}

double positionLogLikelihood(
    const ObjectView& view, const MapObject& object, const AgreementOptions& options)
{
  if (!view.complete)
  {
    const auto [own, other] = depthHypotheses(view, object, options);
    // (12.11)
    return std::max(own, other) + std::log1p(std::exp(-std::abs(own - other)));
  }
  const Eigen::Vector3d off = view.center - object.object.center();
  const Eigen::Matrix3d S_object = positionCovariance(object, options);
  double log = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d n = view.faceNormal(2 * axis);
    const double objectHalf = halfWidthAlong(object.object, n);
    log += axisLogLikelihood(view, axis, n.dot(off), objectHalf, n.dot(S_object * n));
  }
  return log;
}

LabelProperties propertiesOf(const MapObject& object, const LabelTable& labels)
{
  LabelProperties properties = labels.properties(object.label());
  if (object.isRound) properties.shapeExponent = kCylinder;
  return properties;
}

std::optional<ObjectView> measurementOf(
    const MapObject& object,
    ObjectView view,
    const LabelTable& labels,
    const AgreementOptions& options)
{
  if (!labels.compatible(view.label, object.label())) return std::nullopt;
  if (view.complete) return view;
  const auto [own, other] = depthHypotheses(view, object, options);
  view.hasOwnDepth = own >= other;
  if (!view.hasOwnDepth) view.centerCovariance = wrongDepthCovariance(view);
  return view;
}

}  // namespace quadmap
