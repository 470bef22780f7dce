#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
/** Shortens a step so that it stays where the linearisation means something. */
inline UprightState limited(UprightState step)
{
  constexpr double kMaxMove = 0.5, kMaxTurn = 0.35, kMaxScale = 0.5;  // [m], [rad], [-]
  const double factor = std::max(
      {1.0, step.head<3>().norm() / kMaxMove, std::abs(step[3]) / kMaxTurn,
       step.tail<3>().cwiseAbs().maxCoeff() / kMaxScale});
  return step / factor;
}

/** Whether a file may hold the object of a state. What is computed from an edited or absurd file
 * may lead anywhere. */
inline bool isPossible(const UprightState& x)
{
  return x.head<3>().stableNorm() <= kFarthestPosition && !whyNoSize(2 * x.tail<3>().array().exp());
}

/** Minimises by Levenberg-Marquardt. A step to what is no possible object is refused like one that
 * raises the cost. \param x The start, which becomes the minimum.
 * \return The normal equations at the minimum. */
template <typename Linearise>
NormalEquations minimise(const Linearise& linearise, UprightState& x, int maxIterations)
{
  constexpr double kSmallStep = 1e-4;
  NormalEquations eq = linearise(x);
  double lambda = 1e-4;
  for (int iteration = 0; iteration < maxIterations; ++iteration)
  {
    UprightCovariance damped = eq.H;
    damped.diagonal() += lambda * eq.H.diagonal() + UprightState::Constant(1e-9);
    const UprightState step = limited(-damped.ldlt().solve(eq.g));
    if (!step.allFinite()) break;
    const UprightState candidate = x + step;
    const NormalEquations there = linearise(candidate);
    if (there.cost <= eq.cost && isPossible(candidate))
    {
      x = candidate;
      eq = there;
      lambda = std::max(lambda * 0.2, 1e-9);
    }
    else
      lambda *= 10;
    if (step.cwiseAbs().maxCoeff() < kSmallStep || lambda > 1e6) break;
  }
  return eq;
}

}  // namespace quadmap
