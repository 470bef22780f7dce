#include "quadmap/maps/MapOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
constexpr double kLarge = 1e9, kSmall = 1e-9;

void describeAssociation(InsertionOptions& o, OptionList& list)
{
  list.number(
      "alpha", o.association.alpha, {kSmall, kLarge}, "",
      "Concentration of the Dirichlet process. More gives more objects.");
  list.number("beta", o.association.beta, {kSmall, kLarge}, "", "Prior of the label histogram.");
  list.integer("labels", o.association.labels, {1, 1000000}, "", "Number of classes.");
  list.number(
      "newObjectVolume", o.association.newObjectVolume, {kSmall, kLarge}, "m^3",
      "Volume that a new object may lie in.");
  list.number(
      "minJoinPosterior", o.association.minJoinPosterior, {0, 1 - kSmall}, "",
      "A box joins an object only with at least this posterior probability.");
}

void describeAgreement(InsertionOptions& o, OptionList& list)
{
  list.number(
      "extentShare", o.agreement.extentShare, {0, 10}, "",
      "Uncertainty of a seen centre, as a share of the object's half size.");
  list.number(
      "sizeLogSigma", o.agreement.sizeLogSigma, {kSmall, 100}, "ln",
      "Standard deviation of ln(measured size / object's size).");
  list.number(
      "maxSizePenalty", o.agreement.maxSizePenalty, {0, 1000}, "ln",
      "Upper bound of the log-likelihood lost by sizes that differ.");
  list.number(
      "imageWeight", o.agreement.imageWeight, {0, 100}, "",
      "Factor on ln(IoU / 0.5) of the box and the projected object in the image.");
  list.number("minImageIoU", o.agreement.minImageIoU, {kSmall, 1}, "", "Lower bound of that IoU.");
  list.number(
      "labelPenalty", o.agreement.labelPenalty, {0, 1000}, "ln",
      "Log-likelihood lost by labels that are never taken for each other.");
  list.number(
      "wrongDepthShare", o.agreement.wrongDepthShare, {0, 1 - kSmall}, "",
      "Share of partial measurements whose depth is that of another thing.");
  list.number(
      "duplicateIoU", o.agreement.duplicateIoU, {kSmall, 1}, "",
      "Two boxes of one frame with more than this IoU show the same thing.");
  list.number(
      "confusedIoU", o.agreement.confusedIoU, {kSmall, 1}, "",
      "So do two with more than this IoU whose labels a detector takes for each other, and the one "
      "that it is surer of stays. Detectors suppress copies label by label. Of 20 such pairs of "
      "two "
      "real recordings the surer box was right each time.");
}

void describeEstimation(InsertionOptions& o, OptionList& list)
{
  list.integer(
      "maxMeasurementsPerObject", o.estimator.maxMeasurements, {3, 1000000}, "",
      "Most measurements of an object that are kept. Redundant ones go.");
  list.integer(
      "maxIterations", o.estimator.maxIterations, {1, 1000}, "",
      "Most iterations of the optimiser.");
  list.number(
      "huber", o.estimator.huber, {kSmall, 1000}, "sigmas",
      "Residuals beyond this lose weight. Lower bounds of sizes lose most of it.");
  list.number(
      "edgeFloor", o.estimator.edgeFloor, {0, 10}, "m",
      "Fixed part of the standard deviation of every box edge.");
  list.number(
      "edgeShapeShare", o.estimator.edgeShapeShare, {0, 1}, "",
      "All box edges of one side of an object err alike by this share of its mean half size.");
  list.flag(
      "edgesOfComplete", o.estimator.edgesOfComplete,
      "True uses the box edges of complete measurements with unseen sides too.");
  list.number(
      "roundnessSigma", o.estimator.roundnessSigma, {kSmall, 100}, "ln",
      "Standard deviation of ln(a / b) for labels without a dominant direction.");
  list.number(
      "sizePriorSpread", o.estimator.sizePriorSpread, {kSmall, 1000}, "",
      "Factor on the label table's spread of sizes.");
  list.number(
      "seedWeight", o.estimator.seedWeight, {kSmall, 1}, "",
      "Weight of the position that a partial measurement starts with. Many of them err alike.");
  list.number(
      "repeatedThere", o.estimator.repeatedThere, {0, 1}, "",
      "Share of what a view errs by, without its pose, that views from the same place err by "
      "alike. Measured in simulated rooms.");
  list.number(
      "repeatedAnywhere", o.estimator.repeatedAnywhere, {0, 1}, "",
      "The same of views from anywhere: what of an object is seen in all images alike.");
  list.angle(
      "repeatedAngle_deg", o.estimator.repeatedAngle, {0.001, 180},
      "The one becomes the other when the camera moves this far around the object: by 1 - 1/e.");
  list.number(
      "depthScaleSigma", o.estimator.depthScaleSigma, {0, 1}, "",
      "Relative error of all depth of a sensor, as its calibration leaves it. Many views do not "
      "average it out.");
  list.number(
      "posePositionSigma", o.poseNoise.position, {0, 10}, "m",
      "Uncertainty of each coordinate of a pose, or what remains of it where poses are "
      "estimated.");
  list.angle(
      "poseAngleSigma_deg", o.poseNoise.angle, {0, 90},
      "Uncertainty of the orientation of a pose, or what remains of it where poses are "
      "estimated.");
  list.require(
      [&e = o.estimator] { return e.repeatedAnywhere <= e.repeatedThere; },
      "repeatedThere: must be >= repeatedAnywhere");
}

void describeExistence(InsertionOptions& o, OptionList& list)
{
  list.number(
      "detectionProbability", o.existence.detectionProbability, {0.001, 0.999}, "",
      "A visible object is detected with this probability per frame, as long as the run has shown "
      "nothing else: mean of the prior. What each label's objects show then counts on top.");
  list.number(
      "detectionPriorWeight", o.existence.detectionPriorWeight, {kSmall, 1e6}, "looks",
      "Weight of that prior against the run's independent looks. An object's own earlier looks "
      "weigh as much at most: how well it is seen changes with the place.");
  list.number(
      "falseAlarmProbability", o.existence.falseAlarmProbability, {0.0001, 0.999}, "",
      "A box appears where nothing is with this probability per frame.");
  list.number(
      "falseAlarmSpread", o.existence.falseAlarmSpread, {1, 100}, "spreads of the label",
      "The sizes of what does not exist spread by so many spreads of its label, and those of what "
      "exists by one: usual sizes speak for an object. With 1 sizes do not count.");
  list.number(
      "oddShare", o.existence.oddShare, {kSmall, 1}, "",
      "Share of real things whose sizes spread as much as those of false alarms. Its logarithm is "
      "the most that unusual sizes say against an object.");
  list.angle(
      "independentViewAngle_deg", o.existence.independentViewAngle, {0.001, 180},
      "A look counts in full, whether it shows the object or not, when the camera moved this far "
      "around the object since others.");
  list.number(
      "independentViewTime", o.existence.independentViewTime, {kSmall, 1e6}, "s",
      "A look counts in full, too, when there was none from about its place for so long.");
  list.number(
      "repeatedViewWeight", o.existence.repeatedViewWeight, {kSmall, 1}, "",
      "Share of a further look that is independent when the camera did not move at all. All looks "
      "from one place together count as much as 1 / (1 - share) independent ones.");
  list.number(
      "maxLogOdds", o.existence.maxLogOdds, {kSmall, 1000}, "ln",
      "Bound of the evidence, so that it can turn.");
  list.requireLess("falseAlarmProbability", "detectionProbability");
}

void describeConfirmation(InsertionOptions& o, OptionList& list)
{
  list.number(
      "confirmLogOdds", o.existence.confirmLogOdds, {-1000, 1000}, "ln",
      "Objects are reported above these log-odds of their existence. 2.2 is nine to one.");
  list.integer(
      "minObservations", o.existence.minObservations, {1, 1000000}, "",
      "Objects are reported with this many measurements of any kind: one image may be wrong.");
  list.integer(
      "minComplete", o.existence.minComplete, {1, 1000000}, "",
      "Objects are reported with this many complete measurements.");
  list.integer(
      "minPartial", o.existence.minPartial, {1, 1000000}, "",
      "Objects are reported with this many measurements of any kind too.");
  list.number(
      "maxCenterSigma", o.existence.maxCenterSigma, {kSmall, 1000}, "m",
      "Objects are reported below this uncertainty of the centre per axis.");
  list.number(
      "minLabelShare", o.existence.minLabelShare, {0, 1}, "",
      "Objects are reported when at least this share of the labels agrees with their own.");
  list.number(
      "maxSizeDeviation", o.existence.maxSizeDeviation, {kSmall, 1000}, "spreads of the label",
      "Objects with sizes from partial measurements are reported within this of the label's size.");
  list.number(
      "maxSizeSigma", o.existence.maxSizeSigma, {kSmall, 1000}, "m",
      "Such objects are reported below this uncertainty of the half sizes.");
}

void describeMisses(InsertionOptions& o, OptionList& list)
{
  list.number(
      "missMinRange", o.existence.minRange, {0, 1000}, "m", "Misses count from this distance on.");
  list.number(
      "missMaxRange", o.existence.maxRange, {0, 1000}, "m", "Misses count up to this distance.");
  list.number(
      "missMinBoxSize_px", o.existence.minBoxSize, {0, 10000}, "px of the actual image",
      "Misses count for objects of at least this size in the image, or of the size that they were "
      "seen with in this run.");
  list.number(
      "missVisibleShare", o.existence.visibleShare, {kSmall, 1}, "",
      "Misses count when at least this share of the object is inside the image.");
  list.number(
      "missOccluderMargin", o.existence.occluderMargin, {0, 10}, "m",
      "Depth this much nearer than the object hides it.");
  list.number(
      "missMaxHiddenShare", o.existence.maxHiddenShare, {0, 1}, "",
      "A miss does not count when more than this share of the object is hidden.");
}

void describeMerging(InsertionOptions& o, OptionList& list)
{
  list.number(
      "mergeOverlap", o.merging.overlap, {kSmall, 1}, "",
      "Two objects whose labels agree are one at this share of the smaller volume.");
  list.number(
      "mergeAnyLabelIoU", o.merging.anyLabelIoU, {kSmall, 1}, "",
      "Two objects of any labels are one at this IoU.");
  list.number(
      "mergePenetration", o.merging.penetration, {0, 10}, "",
      "Two objects whose labels agree are one with centres nearer than this share of both half "
      "widths too.");
  list.number(
      "mergeMinLabelAgreement", o.merging.minLabelAgreement, {0, 1}, "",
      "Labels agree when at least this share of the measurements does.");
  list.number(
      "mergeMaxTogether", o.merging.maxTogether, {0, 1}, "",
      "Two objects stay two when both have a box in the same image for more than this share of the "
      "boxes of the one that is seen less: a detector draws two for one thing less often. Not used "
      "by method quadric.");
}

void describeWaiting(InsertionOptions& o, OptionList& list)
{
  list.integer(
      "waitingCapacity", o.waiting.capacity, {1, 1000000}, "",
      "Most partial measurements without an object that are kept. With method quadric these are "
      "tracks of boxes.");
  list.integer(
      "waitingMinViews", o.waiting.minViews, {2, 1000}, "",
      "So many of them must agree to start an object.");
  list.angle(
      "waitingMinParallax_deg", o.waiting.minParallax, {0, 180},
      "They must come from directions at least this different.");
  list.number(
      "waitingGateShare", o.waiting.gateShare, {kSmall, 100}, "",
      "They agree within this share of the typical size, plus 0.1 m.");
}

}  // namespace

void InsertionOptions::describe(OptionList& list)
{
  list.about("How measurements become objects: association, estimation, existence, merging.");
  describeAssociation(*this, list);
  describeAgreement(*this, list);
  describeEstimation(*this, list);
  describeExistence(*this, list);
  describeConfirmation(*this, list);
  describeMisses(*this, list);
  describeMerging(*this, list);
  describeWaiting(*this, list);
  list.number(
      "estimateGrowth", estimateGrowth, {0, 10}, "",
      "An object is estimated anew when its measurements are more by this share.");
  list.flag(
      "useInstanceIds", useInstanceIds,
      "True believes the instance ids of the boxes instead of associating.");
  list.number(
      "minScore", minScore, {0, 1}, "", "Boxes that the detector is less sure of are ignored.");
}

void LikelihoodOptions::describe(OptionList& list)
{
  list.about(
      "Log-likelihood of boxes from a pose. It is stored in the map for programs that localise in "
      "it.");
  list.number(
      "positionSigma", positionSigma, {kSmall, 1000}, "m",
      "Standard deviation of a measured centre, beyond the measurement's own.");
  list.angle(
      "yawSigma_deg", yawSigma, {kSmall, 360},
      "Standard deviation of a measured yaw, beyond the measurement's own.");
  list.angle(
      "angleSigma_deg", angleSigma, {kSmall, 360},
      "Standard deviation of a box edge as an angle, beyond the detector's.");
  list.number(
      "outlierShare", outlierShare, {kSmall, 1 - kSmall}, "",
      "Share of the boxes that show nothing of the map.");
  list.flag("onlyConfirmed", onlyConfirmed, "True compares with confirmed objects only.");
}

void RenderOptions::describe(OptionList& list)
{
  list.about("What is drawn of the map. It is stored in the map for programs that draw it.");
  list.flag("cuboids", cuboids, "True draws the wire frame of the circumscribed cuboid.");
  list.flag("ellipsoids", ellipsoids, "True draws the transparent solid ellipsoid.");
  list.flag("labels", labels, "True writes the name and the id above the object.");
  list.flag("unconfirmed", unconfirmed, "True draws objects that are not confirmed too, in grey.");
  list.number("textHeight", textHeight, {kSmall, 100}, "m", "Height of the text of the labels.");
  list.number("opacity", opacity, {0, 1}, "", "Opacity of the ellipsoids.");
}

}  // namespace quadmap
