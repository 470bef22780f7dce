#pragma once

#include <string>

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** Visual odometry. Section [visual] of the configuration. Pixels are those of the working image,
 * the camera's reduced to about 320 columns. */
struct VisualOdometryOptions : public OptionGroup
{
  int features = 800;                //!< Corners followed from a keyframe, >= 50
  double minFeatureDistance = 5;     //!< Between corners [px], >= 1
  double sigmaPixel = 0.5;           //!< Error of a followed corner [px], > 0
  double minRange = 0.3;             //!< Nearer depth is not trusted [m], > 0
  double maxRange = 8.0;             //!< Farther depth is too noisy [m], > minRange
  double depthSigmaFloor = 0.0012;   //!< sigma(z) = floor + growth (z - 0.4 m)^2 [m], > 0
  double depthSigmaGrowth = 0.0019;  //!< [1/m], >= 0
  double denseWeight = 0.25;  //!< Share of a surface point's say, whose errors are correlated, >= 0

  double keyframeTranslation = 0.2;              //!< A keyframe is left after this way [m], > 0
  double keyframeRotation = fromDegrees(15.0L);  //!< ... or turn [rad], > 0; INI in degrees
  double keyframeMinShare = 0.5;   //!< ... or when fewer of its corners are found, in [0, 1]
  int minInliers = 25;             //!< Fewer agreeing corners are a failure, >= 6
  double minInlierShare = 0.3;     //!< ... and a smaller share of those found, in [0, 1]
  double maxSigmaPosition = 0.02;  //!< A motion known less well is a failure [m], > 0
  double maxSigmaAngle = fromDegrees(1.0L);  //!< ... [rad], > 0; INI in degrees
  double maxSpeed = 2.0;                     //!< Nobody carries a camera faster [m/s], > 0
  double maxTurnRate = fromDegrees(200.0L);  //!< ... or turns it faster [rad/s], > 0; INI in deg
  double maxGap = 1.0;    //!< After this long and two images without success: a new start [s], > 0
  double gapSpeed = 0.5;  //!< Sigma of the unseen motion in a gap [m/s], > 0
  double gapTurnRate = fromDegrees(30.0L);  //!< ... [rad/s], > 0; INI in degrees

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
