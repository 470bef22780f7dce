#include "quadmap/maps/ObjectRules.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/maps/Association.h"

namespace quadmap
{
namespace
{
/** -1/2 sum (ln measured/object)^2 / sigma^2 over the axes; a size that is only a lower bound
 * counts when it is larger than the object. */
double sizeTerm(const ObjectView& view, const MapObject& object, const AgreementOptions& options)
{
  if (!view.complete || object.completeCount == 0) return 0;
  const UprightState x = uprightStateOf(object.object);
  const double turned = view.yaw - nearestEquivalentYaw(view.yaw, x[3]);
  Eigen::Vector3d expected = x.tail<3>();
  if (std::lround(turned / (M_PI / 2)) % 2 != 0) std::swap(expected[0], expected[1]);

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

}  // namespace

std::vector<std::string> frequentLabels(const MapObject& object, double share)
{
  double total = 0;
  for (const auto& [name, count] : object.labelCounts) total += count;
  std::vector<std::string> names;
  for (const auto& [name, count] : object.labelCounts)
    if (count >= share * total) names.push_back(name);
  return names;
}

bool labelFits(
    const MapObject& object, const std::string& label, const LabelTable& labels, double share)
{
  for (const auto& name : frequentLabels(object, share))
    if (labels.compatible(name, label)) return true;
  return false;
}

bool areOneObject(
    const MapObject& a, const MapObject& b, const LabelTable& labels, const MergeOptions& options)
{
  const double reach = a.object.semiAxes().norm() + b.object.semiAxes().norm();
  if ((a.object.center() - b.object.center()).norm() > reach) return false;
  const double volumeA = a.object.cuboidVolume(), volumeB = b.object.cuboidVolume();
  const double shared = cuboidIntersectionVolume(a.object, b.object);
  if (shared > options.anyLabelIoU * (volumeA + volumeB - shared)) return true;
  if (shared <= options.overlap * std::min(volumeA, volumeB)) return false;

  for (const auto& name : frequentLabels(a, options.labelShare))
    if (labelFits(b, name, labels, options.labelShare)) return true;
  return false;
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
  const double labelTerm = labelFits(object, view.label, labels, 0.2) ? 0.0 : -options.labelPenalty;
  return sizeTerm(view, object, options) +
         imageTerm(box, object.object, frame, shapeExponent, options) + labelTerm;
}

double positionLogLikelihood(
    const ObjectView& view, const MapObject& object, const AgreementOptions& options)
{
  const Eigen::Vector3d off = view.center - object.object.center();
  const Eigen::Matrix3d R = object.object.rotation();
  const Eigen::Vector3d extent = options.extentShare * object.object.semiAxes();
  const Eigen::Matrix3d S_object =
      object.covariance.topLeftCorner<3, 3>() + R * extent.cwiseAbs2().asDiagonal() * R.transpose();
  if (!view.complete) return logGaussian(off, S_object + view.centerCovariance);

  Eigen::Vector3d difference;
  Eigen::Matrix3d axes;  // of the measured cuboid, as rows
  Eigen::Vector3d variances;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<Eigen::Index>(axis);
    const auto& plus = view.faces[2 * axis];
    const auto& minus = view.faces[2 * axis + 1];
    const Eigen::Vector3d n = view.faceNormal(2 * axis);
    axes.row(i) = n;
    const double center = n.dot(off);
    const double larger =
        supportFunction<double>(R.transpose() * n, object.object.semiAxes(), 2.0) -
        view.halfSizes[i];  // by how much the object is larger on each side
    if (view.axisKnown(axis))
      difference[i] = center;
    else if (isEquality(plus.kind))
      difference[i] = center - larger;
    else if (isEquality(minus.kind))
      difference[i] = center + larger;
    else
      difference[i] =
          std::copysign(std::max(0.0, std::abs(center) - std::max(larger, 0.0)), center);
    variances[i] = view.axisKnown(axis)
                       ? 0.25 * (plus.sigma * plus.sigma + minus.sigma * minus.sigma)
                       : std::pow(isEquality(minus.kind) ? minus.sigma : plus.sigma, 2);
  }
  Eigen::Matrix3d S = axes * S_object * axes.transpose();
  S.diagonal() += variances;
  return logGaussian(difference, S);
}

}  // namespace quadmap
