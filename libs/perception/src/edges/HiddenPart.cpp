#include "quadmap/perception/HiddenPart.h"

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
  const double beyond = e.cuboidBeyond_px + e.cloudShort_px;
  return e.cuboidFit * beyond / (kError_px + kErrorShare * e.size_px);
}

}  // namespace

// The weights come from a logistic regression over simulated rooms, together with ten more pieces
// of evidence and bounds of cloudShort_px, which were left out later; the first one of the
// sides was then raised by 0.1. `observation_tables edge-weights` fits them anew
// (doc/benchmarks.md, "Box edges").
std::vector<HiddenTerm> hiddenTerms(ObjectSide side, const HiddenEvidence& e)
{
  const double cuboid = cuboidBeyond(e);
  const double contact = e.anyContact ? 1.0 : 0.0;
  const double low = std::min(e.tooLow, kMostTooLow);
  const double length = std::log(std::max(e.length_px, kMinSize));
  const double size = std::log(std::max(e.size_px, kMinSize));
  std::vector<HiddenTerm> terms;
  const auto add = [&](const char* name, double evidence, double weight) {
    terms.push_back({name, evidence, weight});
  };
  switch (side)
  {
    case ObjectSide::Top:
      add("constant", 1, -8.8);
      add("slant", e.endAtBorder, 2.2);
      add("cuboid", cuboid, 0.7);
      add("contact", contact, 2.35);
      add("low", low, 0.73);
      break;
    case ObjectSide::Bottom:
      add("constant", 1, -13.5);
      add("nearer", e.nearer, 3.3);
      add("cuboid", cuboid, 2.3);
      add("coverage", e.coverageUnsupported, 2.4);
      add("ln(size)", size, 1.4);
      add("low", low, 0.85);
      break;
    case ObjectSide::Lateral:
      add("constant", 1, -6.6);
      add("nearer ln(length)", e.nearer * length, 1.18);
      add("slant", e.endAtBorder, 4.2);
      add("cuboid", cuboid, 1.73);
      break;
  }
  return terms;
}

double hiddenProbability(ObjectSide side, const HiddenEvidence& evidence)
{
  double logOdds = 0;
  for (const auto& term : hiddenTerms(side, evidence)) logOdds += term.weight * term.evidence;
  return 1.0 / (1.0 + std::exp(-logOdds));
}

}  // namespace quadmap
