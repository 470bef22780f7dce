#pragma once

#include <optional>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/estimation/Visibility.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** What, besides its position, tells whether a box shows an object. */
struct AgreementOptions
{
  double extentShare = 0.3;   //!< Uncertainty of a seen centre, as a share of the half size, >= 0
  double sizeLogSigma = 0.4;  //!< Of ln(measured size / object's size) [-], > 0
  double maxSizePenalty = 8;  //!< Bound of the size term's log-likelihood [-], >= 0
  double imageWeight = 1.5;   //!< Times ln(IoU / 0.5) of the boxes in the image [-], >= 0
  double minImageIoU = 0.05;  //!< Bound of that term, (0, 1)
  double labelPenalty = 5;    //!< Log-likelihood lost by labels never taken for each other, >= 0
  double wrongDepthShare = 0.05;  //!< Of partial measurements whose depth is another thing's [-]
  double duplicateIoU = 0.8;      //!< Two boxes of one frame this alike show the same thing, (0, 1]
  /** ... or this alike, when their labels are two that a detector takes for each other and it is
   * surer of one, (0, 1]. More than duplicateIoU says nothing. */
  double confusedIoU = 0.5;
};

struct MergeOptions
{
  double overlap = 0.4;      //!< Shared volume / smaller volume, for compatible labels, (0, 1]
  double anyLabelIoU = 0.5;  //!< IoU at which the labels no longer matter, (0, 1]
  double penetration = 0.6;  //!< Or: centres nearer than this share of both half widths, >= 0
  double minLabelAgreement = 0.5;  //!< Of their labels (see labelAgreement), in [0, 1]
  /** Two objects that have a box each in the same image for more than this share of the boxes of
   * the one that is seen less stay two, in [0, 1]: a detector draws two for one thing less often.
   * Not used by method quadric. */
  double maxTogether = 0.25;
};

/** Which boxes of a frame stay when each thing has one: of two that show the same thing the one
 * that the detector is surer of. A detector leaves two where two names suit a thing, as it
 * suppresses its own copies label by label (doc/mathematics.md, 12). Boxes whose instance ids
 * differ show two things. */
std::vector<bool> surestOfTwins(
    const std::vector<DetectedObject>& objects,
    const LabelTable& labels,
    const AgreementOptions& options);

/** Share of the object's measurements whose label a detector takes for this one, in [0, 1]:
 * doc/mathematics.md, (12.10). */
double labelAgreement(const MapObject& object, const std::string& label, const LabelTable& labels);

/** The same between two objects: probability that two of their labels, drawn at random, can be
 * taken for each other. */
double labelAgreement(const MapObject& a, const MapObject& b, const LabelTable& labels);

/** What an agreement of labels in [0, 1] says of a measurement being the object's:
 * doc/mathematics.md, (12.9). */
double labelLogLikelihood(double agreement, const AgreementOptions& options);

/** Do two map objects overlap so that they must be one? Two things cannot share their space, but a
 * cup stands within the cuboid of a table with its chairs: only labels a detector takes for each
 * other count, unless the cuboids are nearly the same. */
bool areOneObject(
    const MapObject& a, const MapObject& b, const LabelTable& labels, const MergeOptions& options);

/** Log-likelihood, beyond the position's, that a measurement shows the object: sizes, box in the
 * image, label. Bounded on both sides. */
double agreementLogLikelihood(
    const ObjectView& view,
    const ImageBox& box,
    const MapObject& object,
    const FrameGeometry& frame,
    const LabelTable& labels,
    const AgreementOptions& options);

/** log N of where the measurement is, given the object (doc/mathematics.md: h(x, l_i), S_ik). Along
 * an axis of a cuboid with both ends measured its centre is compared, with one end measured that
 * end, and with none only what sticks out of the object counts. S is the measurement's, the
 * object's and a share of its extent. Of a partial measurement it is the mixture (12.11), as its
 * depth may be another thing's. */
double positionLogLikelihood(
    const ObjectView& view, const MapObject& object, const AgreementOptions& options);

/** Exponents q of what is round in plan: of the circle that its side faces touch, and of its
 * outline in an image, which labels of cylinders have, such as that of cups. */
constexpr double kCircle = 2.0, kCylinder = 1.4;

/** Those of its label, but for the outline of what is round. */
LabelProperties propertiesOf(const MapObject& object, const LabelTable& labels);

/** What a view that shows the object says of its shape and place; nothing when the label is that of
 * another kind, as it was measured with what holds for that kind. The depth of a partial view that
 * is more likely another thing's tells little (doc/mathematics.md, (12.11)). */
std::optional<ObjectView> measurementOf(
    const MapObject& object,
    ObjectView view,
    const LabelTable& labels,
    const AgreementOptions& options);

}  // namespace quadmap
