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
  double tooLow, tooLowAtContact, tooNarrow, tooNarrowAtCut, touching, floating;
};

/** Logistic regression over simulated rooms (doc/benchmarks.md, "Box edges"). `nearer` of lateral
 * edges is raised from the 2.8 found: one that something nearer bounds all along is not to be used,
 * however little such things hid in these rooms. */
constexpr Weights kTop = {-6.9, 0, 0, 0, 0.3, 2.3, 0.4, 0.4, 0.2, 0.9, 0, 0};
constexpr Weights kBottom = {-5.2, 1.8, -0.1, 0.1, 0.4, 0, 1.3, -0.4, -0.3, 1.7, 2.2, 2.2};
constexpr Weights kLateral = {-6.8, 3.4, -0.8, 0.5, 1.3, -0.5, 0.1, 0.5, 0.8, 1.0, 0.4, 2.5};

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
                   w.tooNarrow * tooNarrow + w.touching * e.touching +
                   w.floating * std::max(0.0, e.floating - kFloatingFree);
  if (e.anyContact) logOdds += w.contact + w.tooLowAtContact * tooLow;
  if (e.cutBeside) logOdds += w.cutBeside + w.tooNarrowAtCut * tooNarrow;
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
