#include "quadmap/constellation/Doubles.h"

#include <algorithm>
#include <cmath>

#include "DoublesHypothesis.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
using doubles::Candidate, doubles::DoublesHypothesis;

constexpr double kGate = 11.34;        // chi^2 of three degrees of freedom, 99 %
constexpr double kBoundsMargin = 1.0;  // around the objects, of the area of the map [m]
/** Candidates that are compared with each other, and pairs that are found, at most: the time grows
 * with powers of both. Association finds the other doubles when the poses are right. */
constexpr std::size_t kMostCandidates = 100, kMostPairs = 10;

bool haveOneLabel(
    const MapObject& a,
    const MapObject& b,
    const LabelTable& labels,
    const ConstellationOptions& options)
{
  return labelAgreement(a, b, labels) >= options.minLabelAgreement;
}

/** Smaller and larger horizontal half length [m]. Heights are not compared: see comparedPoint(). */
Eigen::Array2d widthsOf(const MapObject& object)
{
  const Eigen::Vector3d s = object.object.semiAxes();
  return {std::min(s.x(), s.y()), std::max(s.x(), s.y())};
}

Eigen::Vector2d placeOf(const SightedObject& sighted)
{
  return sighted.object->object.center().head<2>();
}

class DoublesFinder
{
 public:
  DoublesFinder(const DoublesRules& rules, const Drift& drift) :
      labels_(rules.labels), options_(rules.options), sighted_(rules.sighted), drift_(drift)
  {
  }

  std::vector<Candidate> candidates() const
  {
    Eigen::AlignedBox2d bounds;
    for (const auto& object : sighted_)
      for (const double margin : {-kBoundsMargin, kBoundsMargin})
        bounds.extend((placeOf(object).array() + margin).matrix());
    std::vector<DoublesHypothesis> explained;
    for (const auto& before : sighted_)
    {
      std::optional<double> logDensity;
      for (const auto& again : sighted_)
      {
        if (!mayBeOne(before, again)) continue;
        if (!logDensity) logDensity = std::log(rivalsOf(before) / bounds.volume());
        addExplained({&before, &again, *logDensity}, explained);
      }
    }
    return likeliestOf(std::move(explained));
  }

  std::optional<Doubles> find(
      const std::vector<Candidate>& candidates, const std::function<bool()>& shouldStop)
  {
    std::vector<DoublesHypothesis> explained;
    for (const Candidate& candidate : candidates) addExplained(candidate, explained);
    candidates_ = likeliestOf(std::move(explained));
    std::vector<DoublesHypothesis> found;
    for (const Candidate& seed : candidates_)
    {
      if (shouldStop()) return std::nullopt;
      if (std::none_of(found.begin(), found.end(), [&](const auto& h) { return h.has(seed); }))
        found.push_back(grownFrom(seed));
    }
    const auto best = std::max_element(
        found.begin(), found.end(),
        [](const auto& a, const auto& b) { return a.logOdds < b.logOdds; });
    if (best == found.end()) return std::nullopt;
    if (best->pairs.size() < static_cast<std::size_t>(options_.minPairs)) return std::nullopt;
    double second = 0;
    for (const DoublesHypothesis& other : found)
      if (other.contradicts(*best) && !leadToOnePlace(other, *best))
        second = std::max(second, other.logOdds);
    if (best->logOdds - second < options_.minLogOdds) return std::nullopt;
    return doublesOf(*best);
  }

 private:
  /** Do both have enough pairs in common, and most of them, to correct the poses alike? What else
   * they take for one another is a matter of a neighbouring thing. */
  bool leadToOnePlace(const DoublesHypothesis& a, const DoublesHypothesis& b) const
  {
    const auto common = std::count_if(
        a.pairs.begin(), a.pairs.end(), [&](const Candidate& pair) { return b.has(pair); });
    const auto most = static_cast<std::ptrdiff_t>(std::max(a.pairs.size(), b.pairs.size()));
    return common >= options_.minPairs && 2 * common > most;
  }

  void addExplained(const Candidate& candidate, std::vector<DoublesHypothesis>& explained) const
  {
    DoublesHypothesis single = evaluated({candidate});
    if (single.distance2 <= kGate) explained.push_back(std::move(single));
  }

  /** \param single Of one candidate each. */
  static std::vector<Candidate> likeliestOf(std::vector<DoublesHypothesis> single)
  {
    std::stable_sort(
        single.begin(), single.end(),
        [](const auto& a, const auto& b) { return a.logOdds > b.logOdds; });
    std::vector<Candidate> likeliest;
    for (std::size_t i = 0; i < std::min(single.size(), kMostCandidates); ++i)
      likeliest.push_back(single[i].pairs.front());
    return likeliest;
  }

  bool mayBeOne(const SightedObject& before, const SightedObject& again) const
  {
    return before.nearest < again.nearest &&
           (widthsOf(*before.object) / widthsOf(*again.object)).log().abs().maxCoeff() <=
               options_.maxSizeLogRatio &&
           haveOneLabel(*before.object, *again.object, labels_, options_) &&
           !wereSeenTogether(before, again);
  }

  /** Number of things with such a label, itself among them. */
  double rivalsOf(const SightedObject& sighted) const
  {
    return static_cast<double>(std::count_if(
        sighted_.begin(), sighted_.end(),
        [&](const auto& other)
        { return haveOneLabel(*sighted.object, *other.object, labels_, options_); }));
  }

  /** The candidate, and those that agree with it, the most telling one first. */
  DoublesHypothesis grownFrom(const Candidate& seed) const
  {
    DoublesHypothesis hypothesis = evaluated({seed});
    while (hypothesis.pairs.size() < kMostPairs)
    {
      auto more = withOneMore(hypothesis);
      if (!more) break;
      hypothesis = std::move(*more);
    }
    return hypothesis;
  }

  std::optional<DoublesHypothesis> withOneMore(const DoublesHypothesis& hypothesis) const
  {
    std::optional<DoublesHypothesis> best;
    for (const Candidate& candidate : candidates_)
    {
      if (hypothesis.shares(candidate)) continue;
      auto pairs = hypothesis.pairs;
      pairs.push_back(candidate);
      DoublesHypothesis more = evaluated(std::move(pairs));
      if (more.distance2 - hypothesis.distance2 <= kGate &&
          more.logOdds > (best ? *best : hypothesis).logOdds)
        best = std::move(more);
    }
    return best;
  }

  /** doc/mathematics.md, (16.24) and (16.25). */
  DoublesHypothesis evaluated(std::vector<Candidate> pairs) const
  {
    const auto n = static_cast<Eigen::Index>(pairs.size());
    Eigen::MatrixXd S(3 * n, 3 * n), horizontal(2 * n, 2 * n);
    Eigen::VectorXd gaps(3 * n);
    double logOdds = 0;
    if (n > 1) logOdds = static_cast<double>(unmatched(pairs)) * std::log(1 - options_.knownShare);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const Candidate& pair = pairs[static_cast<std::size_t>(i)];
      gaps.segment<3>(3 * i) = pair.gap();
      logOdds += std::log(options_.knownShare) - pair.logDensity - std::log(2 * M_PI);
      for (Eigen::Index j = 0; j < n; ++j)
      {
        const Candidate& other = pairs[static_cast<std::size_t>(j)];
        Eigen::Matrix3d block = drift_.covariance(pair.moved(), other.moved());
        if (i == j) block += measured(pair);
        S.block<3, 3>(3 * i, 3 * j) = block;
        horizontal.block<2, 2>(2 * i, 2 * j) = block.topLeftCorner<2, 2>();
      }
    }
    const double distance2 = gaps.dot(S.ldlt().solve(gaps));
    logOdds -= 0.5 * (distance2 + horizontal.ldlt().vectorD().array().log().sum());
    return {std::move(pairs), logOdds, distance2};
  }

  /** Covariance of what was measured of the two, without the drift between them. */
  Eigen::Matrix3d measured(const Candidate& pair) const
  {
    return pair.before->object->covariance.topLeftCorner<3, 3>() +
           pair.again->object->covariance.topLeftCorner<3, 3>() +
           options_.positionSigma * options_.positionSigma * Eigen::Matrix3d::Identity();
  }

  /** Number of objects that are among those seen again, but were not seen before. */
  std::size_t unmatched(const std::vector<Candidate>& pairs) const
  {
    Eigen::AlignedBox2d area;
    std::size_t leftAt = 0;  // keyframe
    for (const Candidate& pair : pairs)
    {
      area.extend(placeOf(*pair.again));
      leftAt = std::max(leftAt, pair.before->nearest);
    }
    const auto isMatched = [&](const SightedObject& object)
    {
      return std::any_of(
          pairs.begin(), pairs.end(), [&](const Candidate& c) { return c.again == &object; });
    };
    return static_cast<std::size_t>(std::count_if(
        sighted_.begin(), sighted_.end(),
        [&](const SightedObject& object)
        {
          return *object.keyframes.begin() > leftAt && area.contains(placeOf(object)) &&
                 !isMatched(object);
        }));
  }

  static Doubles doublesOf(const DoublesHypothesis& hypothesis)
  {
    Doubles doubles;
    doubles.logOdds = hypothesis.logOdds;
    for (const Candidate& pair : hypothesis.pairs)
    {
      const auto &before = *pair.before, &again = *pair.again;
      doubles.pairs.push_back({before.object->id, again.object->id, before.nearest, again.nearest});
      doubles.distance = std::max(doubles.distance, pair.gap().norm());
    }
    return doubles;
  }

  const LabelTable& labels_;
  const ConstellationOptions& options_;
  const std::vector<SightedObject>& sighted_;
  const Drift& drift_;
  std::vector<Candidate> candidates_;
};

}  // namespace

Eigen::Vector3d comparedPoint(const MapObject& object)
{
  return object.object.center() + object.object.semiAxes().z() * Eigen::Vector3d::UnitZ();
}

std::vector<DoublesCandidate> doublesCandidates(const DoublesRules& rules, const Drift& drift)
{
  return DoublesFinder(rules, drift).candidates();
}

std::optional<Doubles> findDoubles(
    const DoublesRules& rules,
    const std::vector<DoublesCandidate>& candidates,
    const Drift& drift,
    const std::function<bool()>& shouldStop)
{
  return DoublesFinder(rules, drift).find(candidates, shouldStop);
}

}  // namespace quadmap
