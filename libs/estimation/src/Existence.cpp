#include "quadmap/estimation/Existence.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
ExistenceEvidence::ExistenceEvidence(double detectionProbability, double falseAlarmProbability) :
    detection_(std::log(detectionProbability / falseAlarmProbability)),
    miss_(std::log((1 - detectionProbability) / (1 - falseAlarmProbability)))
{
}

ExistenceEvidence::ExistenceEvidence(const ExistenceOptions& options) :
    ExistenceEvidence(options.detectionProbability, options.falseAlarmProbability)
{
}

double existenceAfterDetections(double logOdds, double independent, const ExistenceOptions& options)
{
  return std::min(
      options.maxLogOdds, logOdds + independent * ExistenceEvidence(options).detection());
}

double sizeEvidence(
    const Ellipsoid& object,
    const UprightCovariance& covariance,
    const LabelProperties& label,
    const ExistenceOptions& existence,
    const EstimatorOptions& estimator)
{
  if (!label.known) return 0;
  const Eigen::Vector3d logSizes = object.semiAxes().array().log();
  const Eigen::Vector3d deviations =
      (logSizes - typicalLogSizes(logSizes, label)) / label.sizeSpread;
  const double prior = std::pow(label.sizeSpread * estimator.sizePriorSpread, 2);
  const double wider = existence.falseAlarmSpread;
  const auto told = [&](const Eigen::Vector3d& w)  // by the mean with weights w of the logarithms
  {
    const double deviation = w.dot(deviations);
    const double variance = w.dot(covariance.bottomRightCorner<3, 3>() * w);
    // The label is in the estimate, and what is no surer than it alone was not measured.
    const double measured = std::max(0.0, 1 - variance / (prior * w.squaredNorm()));
    return measured * (std::log(wider) - 0.5 * (1 - 1 / (wider * wider)) * deviation * deviation);
  };
  double sum = told(Eigen::Vector3d::UnitZ());
  if (label.dominantDirection)
    sum += told(Eigen::Vector3d::UnitX()) + told(Eigen::Vector3d::UnitY());
  else  // what is as deep as wide, (11.18), has one width
    sum += told({0.5, 0.5, 0});
  return std::log((1 - existence.oddShare) * std::exp(sum) + existence.oddShare);
}

std::optional<ImageBox> outlineInImage(
    const MapObject& object, const FrameGeometry& frame, const LabelTable& labels)
{
  const auto outline =
      projectedBox(object.object, frame, labels.properties(object.label()).shapeExponent);
  if (!outline) return {};
  return outline->clipped(frame.camera.width, frame.camera.height);
}

bool mayShow(
    const ImageBox& box,
    const std::string& label,
    const MapObject& object,
    const ImageBox& outline,
    const LabelTable& labels,
    const ShownRule& rule)
{
  const double iou = imageBoxIoU(box, outline);
  const double shared = iou / (1 + iou) * (box.area() + outline.area());
  return iou >= rule.minIoU && shared >= rule.minInside * box.area() &&
         labelAgreement(object, label, labels) >= rule.minLabelAgreement;
}

}  // namespace quadmap
