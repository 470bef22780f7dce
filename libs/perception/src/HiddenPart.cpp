#include "HiddenPart.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr double kMaxDeviations = 4;   // more tell nothing more, and a label may be wrong
constexpr double kNear = 2.5;          // [m], depth cameras are good up to here
constexpr double kFloatingFree = 0.1;  // lower ends are ragged where the support was cut away

/** Log-odds that the pieces of evidence add. */
struct Weights
{
  double constant, nearer, opposite, far, contact, cutBeside;
  double tooLow, tooLowTouchingBeside, tooNarrow, tooNarrowAtCut, touching, floating;
};

/** Logistic regression over simulated rooms (doc/benchmarks.md, "Box edges"). */
constexpr Weights kTop = {-7.5, 0.3, -1.6, -1.4, 1.9, 2.5, 0.9, 0.3, 0.3, 0.5, 0, -1.6};
constexpr Weights kBottom = {-5.3, 3.2, -0.5, 0, 0.2, 1.1, 0.6, -0.2, 0, 0.6, 1.0, 3.7};
constexpr Weights kLateral = {-5.6, 3.8, -1.5, 0, 0.5, 0.6, 0, 0.6, 0.7, 0.4, 0.2, 2.4};

}  // namespace

double hiddenProbability(ObjectSide side, const HiddenEvidence& e)
{
  const Weights& w = side == ObjectSide::Top      ? kTop
                     : side == ObjectSide::Bottom ? kBottom
                                                  : kLateral;
  const double tooLow = std::min(e.tooLow, kMaxDeviations);
  const double tooNarrow = std::min(e.tooNarrow, kMaxDeviations);
  double logOdds = w.constant + w.nearer * e.nearer + w.opposite * e.opposite +
                   w.far * std::max(0.0, e.depth - kNear) + w.tooLow * tooLow +
                   w.tooLowTouchingBeside * tooLow * e.touchingBeside + w.tooNarrow * tooNarrow +
                   w.touching * e.touching + w.floating * std::max(0.0, e.floating - kFloatingFree);
  if (e.anyContact) logOdds += w.contact;
  if (e.cutBeside) logOdds += w.cutBeside + w.tooNarrowAtCut * tooNarrow;
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
