#include "edges/HiddenPart.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr double kMostTooLow = 6;  // more tells nothing more, and a label may be wrong
constexpr double kMinSize = 5;     // [px of an image 640 wide]

/** The evidence of the cuboid, equation (9.4): how far it reaches beyond the edge, divided by its
 * error. A cuboid that does not fit the box counts for less, as it is not the object's. */
double cuboidBeyond(const HiddenEvidence& e)
{
  constexpr double kError_px = 6, kErrorShare = 0.1;
  // What lies further inside or outside is another thing, or not well fitted.
  constexpr double kMinShort_px = -30, kMaxShort_px = 10;
  const double beyond = e.cuboidBeyond_px + std::clamp(e.cloudShort_px, kMinShort_px, kMaxShort_px);
  return e.cuboidFit * beyond / (kError_px + kErrorShare * e.size_px);
}

}  // namespace

double hiddenProbability(ObjectSide side, const HiddenEvidence& e)
{
  double logOdds = 0;
  const auto add = [&](double piece, double top, double bottom, double lateral)
  {
    logOdds += piece * (side == ObjectSide::Top      ? top
                        : side == ObjectSide::Bottom ? bottom
                                                     : lateral);
  };
  // Equation (9.2). The weights come from a logistic regression over simulated rooms
  // (doc/benchmarks.md, "Box edges"). They were fitted together with ten more pieces of evidence,
  // which were left out later; the first one of the sides was then raised by 0.1.
  add(1, -8.8, -13.5, -6.6);
  add(e.nearer, 0, 3.3, 0);
  add(e.nearer * std::log(std::max(e.length_px, kMinSize)), 0, 0, 1.18);
  add(e.endAtBorder, 2.2, 0, 4.2);
  add(cuboidBeyond(e), 0.7, 2.3, 1.73);
  add(e.coverageUnsupported, 0, 2.4, 0);
  add(std::log(std::max(e.size_px, kMinSize)), 0, 1.4, 0);
  add(e.anyContact ? 1.0 : 0.0, 2.35, 0, 0);
  add(std::min(e.tooLow, kMostTooLow), 0.73, 0.85, 0);
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
