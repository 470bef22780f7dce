#include "ConsistentPairs.h"

#include <algorithm>
#include <vector>

namespace quadmap
{
namespace
{
/** Not all pairs of a place err alike: some were seen from other sides than before. So the spread
 * of those that agree well says only so much of another one. Share of the sigmas of (19.1). */
constexpr double kLeastSpread = 0.5;

/** Squared distance of pair k from where the others put it, in sigmas of their spread:
 * doc/mathematics.md, (19.5) and (19.6). It is 0 when the others fix no place. */
double distanceFromOthers(
    const PlaceEvidence& evidence, const PlacedObjects& placed, const Pairs& pairs, std::size_t k)
{
  Pairs others = pairs;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
  const auto found = evidence.normalEquations(placed, others).solved();
  if (!found) return 0;
  const auto distance = [&](const Pairs::value_type& pair, const Eigen::Matrix4d& ofPlace)
  {
    const auto gap = evidence.gap(placed, pair.first, pair.second);
    const Eigen::Vector3d d = gap.d - gap.J * found->step;
    return d.dot((gap.S + gap.J * ofPlace * gap.J.transpose()).ldlt().solve(d));
  };
  double sum = 0;
  for (const auto& pair : others) sum += distance(pair, Eigen::Matrix4d::Zero());
  const double freedom = std::max(0.0, 3.0 * static_cast<double>(others.size()) - 4);
  const double variance = std::clamp((3 + sum) / (3 + freedom), kLeastSpread * kLeastSpread, 1.0);
  return distance(pairs[k], found->covariance) / variance;
}

}  // namespace

Pairs consistentPairs(const PlaceEvidence& evidence, Pairs pairs, Place& place)
{
  while (pairs.size() > 2)
  {
    const PlacedObjects placed(evidence.both().local, place);
    std::vector<double> distances;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      distances.push_back(distanceFromOthers(evidence, placed, pairs, k));
    const auto worst = std::max_element(distances.begin(), distances.end());
    if (*worst <= PlaceEvidence::kGate) break;
    pairs.erase(pairs.begin() + (worst - distances.begin()));
    place = evidence.improved(place, pairs);
  }
  return pairs;
}

}  // namespace quadmap
