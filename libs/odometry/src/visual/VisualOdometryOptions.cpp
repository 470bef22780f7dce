#include "quadmap/odometry/VisualOdometryOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
void describeCorners(VisualOdometryOptions& o, OptionList& list)
{
  list.integer(
      "features", o.features, {50, 100000}, "", "Number of corners followed from a keyframe.");
  list.number(
      "minFeatureDistance", o.minFeatureDistance, {1, 100}, "px",
      "Least distance between two corners.");
  list.number(
      "sigmaPixel", o.sigmaPixel, {0.01, 100}, "px",
      "Standard deviation of the place of a followed corner.");
  list.number("minRange", o.minRange, {0.01, 100}, "m", "Nearer depth is not trusted.");
  list.number("maxRange", o.maxRange, {0.02, 100}, "m", "Farther depth is too noisy.");
  list.number(
      "depthSigmaFloor", o.depthSigmaFloor, {1e-5, 1}, "m",
      "Depth noise at 0.4 m: sigma(z) = depthSigmaFloor + depthSigmaGrowth (z - 0.4 m)^2.");
  list.number(
      "depthSigmaGrowth", o.depthSigmaGrowth, {0, 1}, "1/m",
      "Growth of the depth noise in that equation.");
  list.number(
      "denseWeight", o.denseWeight, {0, 10}, "",
      "Weight of a surface point. It is below 1 because the errors of neighbours are alike. 0 uses "
      "corners only.");
}

void describeKeyframes(VisualOdometryOptions& o, OptionList& list)
{
  list.number(
      "keyframeTranslation", o.keyframeTranslation, {1e-3, 10}, "m",
      "A keyframe is left after this way.");
  list.angle(
      "keyframeRotation_deg", o.keyframeRotation, {0.1, 180},
      "A keyframe is left after this turn.");
  list.number(
      "keyframeMinShare", o.keyframeMinShare, {0, 1}, "",
      "A keyframe is left when a smaller share of its corners is found.");
}

void describeFailures(VisualOdometryOptions& o, OptionList& list)
{
  list.integer(
      "minInliers", o.minInliers, {6, 100000}, "", "Fewer corners that agree are a failure.");
  list.number(
      "minInlierShare", o.minInlierShare, {0, 1}, "",
      "A smaller share of the found corners that agree is a failure.");
  list.number(
      "maxSigmaPosition", o.maxSigmaPosition, {1e-5, 10}, "m",
      "A motion whose position is known less well is a failure.");
  list.angle(
      "maxSigmaAngle_deg", o.maxSigmaAngle, {1e-3, 180},
      "A motion whose angles are known less well is a failure.");
  list.number(
      "maxSpeed", o.maxSpeed, {1e-3, 100}, "m/s",
      "A faster motion is a failure, because nobody carries a camera faster.");
  list.angle(
      "maxTurnRate_deg", o.maxTurnRate, {0.1, 7200},
      "A faster turn, per second, is a failure, because nobody turns a camera faster.");
  list.number(
      "maxGap", o.maxGap, {1e-3, 3600}, "s",
      "After this long and two images without success the next good image starts anew, as if there "
      "had been no motion.");
  list.number(
      "gapSpeed", o.gapSpeed, {1e-3, 100}, "m/s",
      "Standard deviation of the unseen motion in such a gap, per second.");
  list.angle(
      "gapTurnRate_deg", o.gapTurnRate, {0.1, 7200},
      "Standard deviation of the unseen turn in such a gap, per second.");
}

}  // namespace

void VisualOdometryOptions::describe(OptionList& list)
{
  list.about(
      "Visual odometry. Pixels are those of the working image, the camera's reduced to about 320 "
      "columns.");
  describeCorners(*this, list);
  describeKeyframes(*this, list);
  describeFailures(*this, list);
  list.requireLess("minRange", "maxRange");
}

}  // namespace quadmap
