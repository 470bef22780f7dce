#pragma once

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/NormalEquations.h"

namespace quadmap
{
/** What is known of position and yaw without any measurement, doc/mathematics.md, (11.20). */
inline UprightCovariance freeInformation()
{
  UprightCovariance information = UprightCovariance::Zero();
  information.diagonal().head<3>().setConstant(1.0 / (kFreePositionSigma * kFreePositionSigma));
  information(3, 3) = 1.0 / (kFreeAngleSigma * kFreeAngleSigma);
  return information;
}

}  // namespace quadmap
