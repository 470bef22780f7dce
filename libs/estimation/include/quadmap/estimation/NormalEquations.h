#pragma once

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
/** What is known of an object without any measurement, doc/mathematics.md, (11.20): it is within
 * this part of a room [m], and an undefined yaw is somewhere within 45 degrees [rad]. */
constexpr double kFreePositionSigma = 2.0, kFreeAngleSigma = M_PI / 4;

/** Normal equations of a robust least-squares problem at one state of an upright object:
 * cost ~ 1/2 d^T H d + g^T d. */
struct NormalEquations
{
  UprightCovariance H = UprightCovariance::Zero();
  UprightState g = UprightState::Zero();
  double cost = 0;

  /** Adds one residual in sigmas with its derivatives. \param weight Of the residual, > 0. */
  void add(
      double residual,
      const UprightState& jacobian,
      const RobustKernel& kernel,
      double weight = 1.0)
  {
    const double w = weight * kernel.weight(residual);
    if (w == 0) return;  // a satisfied inequality
    cost += weight * kernel.cost(residual);
    H.noalias() += w * jacobian * jacobian.transpose();
    g.noalias() += w * residual * jacobian;
  }
};

}  // namespace quadmap
