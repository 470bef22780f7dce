#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** How the objects of two maps of one place find each other. Part of section [relocalization]. */
struct ConstellationOptions : public OptionGroup
{
  /** Standard deviation of an object's place in the map beyond both covariances [m], > 0: a run
   * drifts, and some sides only one of the two saw. */
  double positionSigma = 0.08;
  double yawSigma = fromDegrees(5.0L);  //!< The same of its heading [rad], > 0; INI in degrees
  double maxSizeLogRatio = 0.5;    //!< |ln| of how much their sizes differ at most, per axis, > 0
  double minLabelAgreement = 0.5;  //!< Of their labels (see labelAgreement), in [0, 1]
  /** Of the local objects in the area of the map, the share it has; the others were moved or
   * brought, in (0, 1) */
  double knownShare = 0.5;
  /** Objects found again, at least; one fewer will do when one has a heading, >= 2 */
  int minPairs = 3;
  /** How much more likely the place must be than any other and than chance [ln], > 0; 4.6: 100
   * times. So sure must it be, too, that an object is gone */
  double minLogOdds = 4.6;

 protected:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
