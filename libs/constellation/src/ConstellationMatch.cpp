#include "quadmap/constellation/ConstellationMatch.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "ConsistentPairs.h"
#include "PlaceEvidence.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kMaxPlaces = 60;  // guesses that are looked at closely
constexpr int kRefinements = 6;         // of a guess: pairs and place in turn
constexpr double kOtherPlace = 0.5;     // [m] at the objects: nearer ones are the same place
const double kOtherYaw = mrpt::DEG2RAD(20.0);

struct Hypothesis
{
  Place place;
  Pairs pairs;
  double logOdds = 0;
};

Eigen::Vector3d orderedSizes(const MapObject& object)
{
  Eigen::Vector3d s = object.object.semiAxes();
  if (s.x() > s.y()) std::swap(s.x(), s.y());
  return s;
}

class Matcher
{
 public:
  using Objects = Constellations::Objects;

  Matcher(
      const Objects& local,
      const Objects& map,
      const LabelTable& labels,
      const ConstellationOptions& options) :
      options_(options), evidence_(local, map, labels, options), local_(local)
  {
    for (const MapObject* object : local) middle_ += object->object.center() / local.size();
  }

  std::optional<ConstellationMatch> match() const
  {
    std::vector<Hypothesis> found;
    for (const Place& guess : bestGuesses()) found.push_back(refined(guess));
    std::stable_sort(
        found.begin(), found.end(),
        [](const auto& a, const auto& b) { return a.logOdds > b.logOdds; });
    if (found.empty()) return std::nullopt;
    const double second = bestElsewhere(found);
    const Hypothesis best = agreed(found.front());
    if (!isEnough(best.pairs) || best.logOdds < options_.minLogOdds ||
        best.logOdds - second < options_.minLogOdds)
      return std::nullopt;
    ConstellationMatch result;
    result.T_map_local = mrpt::poses::CPose3D(
        best.place.t.x(), best.place.t.y(), best.place.t.z(), best.place.yaw, 0, 0);
    for (const auto& [i, j] : best.pairs)
      result.pairs.emplace_back(local_[i]->id, evidence_.both().map[j]->id);
    result.logOdds = best.logOdds;
    result.secondLogOdds = second;
    return result;
  }

 private:
  bool areDistinct(const Place& a, const Place& b) const
  {
    const Eigen::Vector3d shift = a.R() * middle_ + a.t - b.R() * middle_ - b.t;
    return shift.norm() > kOtherPlace || std::abs(mrpt::math::wrapToPi(a.yaw - b.yaw)) > kOtherYaw;
  }

  /** The most promising guesses, best first. At most two describe the same place, because one may
   * have started from a wrong pair. */
  std::vector<Place> bestGuesses() const
  {
    constexpr int kOfOnePlace = 2;
    std::vector<std::pair<double, Place>> scored;
    for (const Place& place : guessPlaces(evidence_.both(), options_))
      scored.emplace_back(evidence_.coarse(place), place);
    std::stable_sort(
        scored.begin(), scored.end(), [](auto& a, auto& b) { return a.first > b.first; });
    std::vector<Place> best;
    for (const auto& guess : scored)
    {
      if (best.size() >= kMaxPlaces) break;
      const Place& place = guess.second;
      const auto near = std::count_if(
          best.begin(), best.end(), [&](const Place& b) { return !areDistinct(place, b); });
      if (near < kOfOnePlace) best.push_back(place);
    }
    return best;
  }

  Hypothesis refined(const Place& guess) const
  {
    Hypothesis h;
    h.place = guess;
    for (int k = 0; k < kRefinements; ++k)
    {
      h.pairs = evidence_.pairsAt(
          PlacedObjects(local_, h.place), k == 0 ? PlaceEvidence::kCoarseFactor : 1);
      h.place = evidence_.improved(h.place, h.pairs);
    }
    h.pairs = evidence_.pairsAt(PlacedObjects(local_, h.place), 1);
    h.logOdds = logOdds(h);
    return h;
  }

  /** Without the pairs that the others contradict. */
  Hypothesis agreed(Hypothesis h) const
  {
    h.pairs = consistentPairs(evidence_, h.pairs, h.place);
    // Those had pulled the place away from others, which are pairs again where it is now.
    h.pairs = evidence_.pairsAt(PlacedObjects(local_, h.place), 1);
    h.pairs = consistentPairs(evidence_, h.pairs, h.place);
    h.logOdds = logOdds(h);
    return h;
  }

  /** doc/mathematics.md, (19.4). */
  double logOdds(const Hypothesis& h) const
  {
    const PlacedObjects placed(local_, h.place);
    double sum = logUnknown(placed, h.pairs) - logPlaces(placed, h.pairs);
    for (const auto& [i, j] : h.pairs) sum += evidence_.of(placed, i, j, 1);
    return sum;
  }

  /** ln of the probability that the map lacks every local object within its area. Unmatched objects
   * thus speak against a place. */
  double logUnknown(const PlacedObjects& placed, const Pairs& pairs) const
  {
    std::vector<bool> counts(local_.size());
    for (std::size_t i = 0; i < local_.size(); ++i)
      counts[i] = evidence_.bounds().contains(placed.centers[i].head<2>());
    for (const auto& [i, j] : pairs) counts[i] = true;
    const auto n = std::count(counts.begin(), counts.end(), true);
    return static_cast<double>(n) * std::log(1 - options_.knownShare);
  }

  /** ln of the number of places that can be told apart, as finely as the pairs fix this one: so
   * many chances some objects had to fit by accident. */
  double logPlaces(const PlacedObjects& placed, const Pairs& pairs) const
  {
    const auto normal = evidence_.normalEquations(placed, pairs);
    Eigen::Matrix3d H;  // x, y, yaw
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) H(r, c) = normal.H(r == 2 ? 3 : r, c == 2 ? 3 : c);
    const double cells = evidence_.bounds().volume() * 2 * M_PI *
                         std::sqrt(std::max(0.0, H.determinant())) / std::pow(2 * M_PI, 1.5);
    return std::log(std::max(1.0, cells));
  }

  double bestElsewhere(const std::vector<Hypothesis>& sorted) const
  {
    for (const auto& h : sorted)
      if (areDistinct(h.place, sorted.front().place)) return std::max(0.0, h.logOdds);
    return 0;
  }

  bool isEnough(const Pairs& pairs) const
  {
    const bool heading = std::any_of(
        pairs.begin(), pairs.end(),
        [&](auto& p) { return evidence_.both().bothHaveHeadings(p.first, p.second); });
    return pairs.size() >= 2 &&
           pairs.size() + (heading ? 1 : 0) >= static_cast<std::size_t>(options_.minPairs);
  }

  const ConstellationOptions& options_;
  PlaceEvidence evidence_;
  const Objects& local_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  //!< Of the local objects
};

}  // namespace

bool areAlike(
    const MapObject& a,
    const MapObject& b,
    const LabelTable& labels,
    const ConstellationOptions& options)
{
  if (labelAgreement(a, b, labels) < options.minLabelAgreement) return false;
  const Eigen::Array3d ratio = orderedSizes(a).array() / orderedSizes(b).array();
  return ratio.log().abs().maxCoeff() <= options.maxSizeLogRatio;
}

std::optional<ConstellationMatch> matchConstellation(
    const std::vector<const MapObject*>& local,
    const std::vector<const MapObject*>& map,
    const LabelTable& labels,
    const ConstellationOptions& options)
{
  if (local.empty() || map.empty()) return std::nullopt;
  return Matcher(local, map, labels, options).match();
}

}  // namespace quadmap
