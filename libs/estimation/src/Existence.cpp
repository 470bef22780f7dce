#include "quadmap/estimation/Existence.h"

#include <algorithm>
#include <cmath>

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
