#include "HiddenPart.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr double kMaxDeviations = 4;   // more tell nothing more, and a label may be wrong
constexpr double kNear = 2.5;          // [m], depth cameras are good up to here
constexpr double kFloatingFree = 0.1;  // lower ends are ragged where the support was cut away
/** A cuboid that ends further inside or outside is another thing, or not well fitted. */
constexpr double kMinBeyond_px = -20, kMaxBeyond_px = 60;
constexpr double kMinBeyondShare = -0.2, kMaxBeyondShare = 1;

}  // namespace

double hiddenProbability(ObjectSide side, const HiddenEvidence& e)
{
  const double tooLow = std::min(e.tooLow, kMaxDeviations);
  const double tooNarrow = std::min(e.tooNarrow, kMaxDeviations);
  const double cutBeside = e.cutBeside ? 1 : 0;
  double logOdds = 0;
  const auto add = [&](double piece, double top, double bottom, double lateral)
  {
    logOdds += piece * (side == ObjectSide::Top      ? top
                        : side == ObjectSide::Bottom ? bottom
                                                     : lateral);
  };
  // Logistic regression over simulated rooms (doc/benchmarks.md, "Box edges").
  add(1, -9.7, -5.7, -7.2);
  add(e.nearer, 0, 2.2, 4.8);
  add(e.touching, 0, 1.0, 0);
  add(e.opposite, -1.7, -1.7, -1.9);
  add(e.endBeside, 1.5, 1.1, 0);
  add(e.endAtBorder, 2.4, 1.2, 3.4);
  add(e.nearerInside, 3.2, 0.7, 0);
  add(std::clamp(e.cuboidBeyond_px, kMinBeyond_px, kMaxBeyond_px), 0.031, 0.082, 0.041);
  add(std::clamp(e.cuboidBeyondShare, kMinBeyondShare, kMaxBeyondShare), 0, -3.1, 0);
  add(std::max(0.0, e.depth - kNear), -1.3, 0, 0);
  add(e.anyContact ? 1.0 : 0.0, 2.4, 0, 0.9);
  add(cutBeside, 2.0, 1.0, 0.6);
  add(cutBeside * tooNarrow, 0.5, 0.8, 0);
  add(tooNarrow, 0, 0, 0.8);
  add(tooLow, 0.8, 0.6, 0);
  add(tooLow * e.touchingBeside, 0, 0, 0.8);
  add(std::min(e.topTooLow, kMaxDeviations), 2.0, 0, 0);
  add(std::max(0.0, e.floating - kFloatingFree), 0, 2.4, 2.8);
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
