#include "edges/HiddenPart.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr double kMaxDeviations = 4;   // more tell nothing more, and a label may be wrong
constexpr double kFloatingFree = 0.1;  // lower ends are ragged where the support was cut away
constexpr double kMinSize = 5;         // [px of an image 640 wide]

/** The evidence of the cuboid, equation (9.4): how far it reaches beyond the edge, divided by its
 * error. A cuboid that does not fit the box counts for less, as it is not the object's. */
double cuboidBeyond(const HiddenEvidence& e)
{
  constexpr double kError_px = 6, kErrorShare = 0.1;
  // What lies further inside or outside is another thing, or not well fitted.
  constexpr double kMinShort_px = -30, kMaxShort_px = 10, kMin = -1, kMax = 3;
  const double beyond = e.cuboidBeyond_px + std::clamp(e.cloudShort_px, kMinShort_px, kMaxShort_px);
  return e.cuboidFit * std::clamp(beyond / (kError_px + kErrorShare * e.size_px), kMin, kMax);
}

}  // namespace

double hiddenProbability(ObjectSide side, const HiddenEvidence& e)
{
  const double tooLow = std::min(e.tooLow, kMaxDeviations);
  const double tooNarrow = std::min(e.tooNarrow, kMaxDeviations);
  const double cutBeside = e.cutBeside ? 1 : 0;
  const double cuboid = cuboidBeyond(e);
  double logOdds = 0;
  const auto add = [&](double piece, double top, double bottom, double lateral)
  {
    logOdds += piece * (side == ObjectSide::Top      ? top
                        : side == ObjectSide::Bottom ? bottom
                                                     : lateral);
  };
  // Equation (9.2). The weights come from a logistic regression over simulated rooms
  // (doc/benchmarks.md, "Box edges").
  add(1, -8.8, -13.5, -6.7);
  add(e.nearer, 0, 3.3, 0);
  add(e.nearer * std::log(std::max(e.length_px, kMinSize)), 0, 0, 1.18);
  add(e.opposite, -2.5, 0, -1.7);
  add(e.endAtBorder, 2.2, 0, 4.2);
  add(e.nearerInside, 4.1, 0.8, 0);
  add(cuboid, 0.7, 2.3, 1.73);
  add(std::max(0.0, cuboid) * e.noDepth, 0, 3.7, 0);
  add(e.withoutCloud ? 1.0 : 0.0, 0, 0, 1.9);
  add(e.coverageUnsupported, 0, 2.4, 0);
  add(std::log(std::max(e.size_px, kMinSize)), 0, 1.4, 0);
  add(e.anyContact ? 1.0 : 0.0, 2.35, 0, 0);
  add(cutBeside, 1.45, 1.1, 0);
  add(cutBeside * tooNarrow, 0, 1.15, 0);
  add(cutBeside * std::min(e.topTooLow, kMaxDeviations), 2.7, 0, 0);
  add(tooNarrow, 0, 0, 0.7);
  add(tooLow, 0.73, 0.85, 0);
  add(tooLow * e.touchingBeside, 0, 0, 0.93);
  add(std::max(0.0, e.floating - kFloatingFree), 0, 0, 2.6);
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
