#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** How a run finds itself in an existing object map. Section [relocalization]. */
struct RelocalizationOptions : public OptionGroup
{
  /** Standard deviation of an object's place in the map beyond both covariances [m], > 0: the run
   * drifts, and some sides only one of the two saw. */
  double positionSigma = 0.08;
  double yawSigma = fromDegrees(5.0L);  //!< The same of its heading [rad], > 0; INI in degrees
  /** How far the sides of a known object are from where the map has them, beyond its covariance:
   * drift of the run that made it, sides that only one of them saw [m], > 0. So tightly do known
   * objects hold the poses */
  double mapSigma = 0.01;
  double maxSizeLogRatio = 0.5;    //!< |ln| of how much their sizes differ at most, per axis, > 0
  double minLabelAgreement = 0.5;  //!< Of their labels (see labelAgreement), in [0, 1]
  /** Of the run's objects in the area of the map, the share it has; the others were moved or
   * brought, in (0, 1) */
  double knownShare = 0.5;
  /** Objects found again, at least; one fewer will do when one has a heading, >= 2 */
  int minPairs = 3;
  /** How much more likely the place must be than any other and than chance [ln], > 0; 4.6: 100
   * times. So sure must it be, too, that an object is gone */
  double minLogOdds = 4.6;

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
