#pragma once

#include <optional>
#include <string>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/Visibility.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Log-odds that frames add to an object's existence, from the rates of a detector. */
class ExistenceEvidence
{
 public:
  /** \param detectionProbability p_D of a visible object, per frame, in (0, 1).
   *  \param falseAlarmProbability p_FA of a box where nothing is, in (0, p_D). */
  ExistenceEvidence(double detectionProbability, double falseAlarmProbability);
  explicit ExistenceEvidence(const ExistenceOptions& options);

  /** Of a frame that shows the object, doc/mathematics.md, (13.2); > 0. */
  double detection() const { return detection_; }
  /** Of a frame that should have shown the object and did not, doc/mathematics.md, (13.2); < 0. */
  double miss() const { return miss_; }

 private:
  double detection_, miss_;
};

/** Log-odds after so many independent detections, (13.2), bounded by maxLogOdds. */
double existenceAfterDetections(
    double logOdds, double independent, const ExistenceOptions& options);

/** Log-odds that an object's sizes add to its existence, doc/mathematics.md, (13.8): false alarms
 * seldom have the usual sizes of their label. Sizes that nothing but the label tells add nothing.
 * \param covariance Of an estimate with the label's prior (see labelPriorRows).
 * \return 0 of a label that the table does not know. */
double sizeEvidence(
    const Ellipsoid& object,
    const UprightCovariance& covariance,
    const LabelProperties& label,
    const ExistenceOptions& existence,
    const EstimatorOptions& estimator);

/** When a box that was not joined with an object shows it all the same. */
struct ShownRule
{
  double minIoU = 0.2;     //!< Of the box with the object's outline: it is no speck in it
  double minInside = 0.5;  //!< Least share of the box inside the outline, in [0, 1]
  double minLabelAgreement =
      0.5;  //!< Least agreement of the labels (see labelAgreement), in [0, 1]
};

/** Outline of the object in the image, as far as the image shows it. */
std::optional<ImageBox> outlineInImage(
    const MapObject& object, const FrameGeometry& frame, const LabelTable& labels);

/** True when the box may show the object with that outline.
 * \param label Canonical label of the box. */
bool mayShow(
    const ImageBox& box,
    const std::string& label,
    const MapObject& object,
    const ImageBox& outline,
    const LabelTable& labels,
    const ShownRule& rule);

}  // namespace quadmap
