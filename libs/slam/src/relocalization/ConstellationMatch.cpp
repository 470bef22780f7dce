#include "relocalization/ConstellationMatch.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "PlaceGuesses.h"
#include "quadmap/estimation/Assignment.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
constexpr double kGate = 11.34;         // chi^2 of three degrees of freedom, 99 %
constexpr double kYawGate = 6.63;       // of one
constexpr double kCoarseFactor = 2;     // on sigmas, while a place is only guessed from a pair
constexpr std::size_t kMaxPlaces = 60;  // guesses that are looked at closely
constexpr int kRefinements = 6;         // of a guess: pairs and place in turn
constexpr double kOtherPlace = 0.5;     // [m] at the objects: nearer ones are the same place
const double kOtherYaw = mrpt::DEG2RAD(20.0);
constexpr double kMargin = 0.5;        // around the objects of the map, for its area [m]
constexpr double kMaxYawEvidence = 2;  // bound of what one heading says for or against a pair

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  //!< (local, map), indices

struct Hypothesis
{
  Place place;
  Pairs pairs;
  double logOdds = 0;
};

/** The local objects in the map's frame, as they are placed by one guess. */
struct PlacedObjects
{
  PlacedObjects(const Constellations::Objects& local, const Place& at) : place(at)
  {
    const Eigen::Matrix3d R = at.R();
    for (const MapObject* object : local)
    {
      centers.emplace_back(R * object->object.center() + at.t);
      covariances.emplace_back(R * object->covariance.topLeftCorner<3, 3>() * R.transpose());
    }
  }

  Place place;
  std::vector<Eigen::Vector3d> centers;
  std::vector<Eigen::Matrix3d> covariances;  // of the centres
};

/** Angle to the nearest multiple of a quarter turn [rad]. Which axis of a cuboid is called x is
 * arbitrary. */
double withinQuarterTurn(double angle) { return std::remainder(angle, M_PI / 2); }

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
      const RelocalizationOptions& options) :
      local_(local),
      map_(map),
      options_(options),
      both_{local, map, std::vector<std::vector<std::size_t>>(local.size())}
  {
    std::vector<std::size_t> rivals(map.size());
    for (std::size_t j = 0; j < map.size(); ++j)
      for (const MapObject* other : map)
        rivals[j] += labelAgreement(*map[j], *other, labels) >= options.minLabelAgreement;
    for (std::size_t i = 0; i < local.size(); ++i)
      for (std::size_t j = 0; j < map.size(); ++j)
        if (areAlike(*local[i], *map[j], labels, options)) both_.alike[i].push_back(j);
    for (const MapObject* object : map)
      for (const double margin : {-kMargin, kMargin})
        bounds_.extend((object->object.center().head<2>().array() + margin).matrix());
    area_ = bounds_.volume();
    for (const std::size_t n : rivals)
      logDensity_.push_back(std::log(static_cast<double>(std::max<std::size_t>(1, n)) / area_));
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
    const Hypothesis& best = found.front();
    const double second = bestElsewhere(found);
    if (!isEnough(best.pairs) || best.logOdds < options_.minLogOdds ||
        best.logOdds - second < options_.minLogOdds)
      return std::nullopt;
    ConstellationMatch result;
    result.T_map_local = mrpt::poses::CPose3D(
        best.place.t.x(), best.place.t.y(), best.place.t.z(), best.place.yaw, 0, 0);
    for (const auto& [i, j] : best.pairs) result.pairs.emplace_back(local_[i]->id, map_[j]->id);
    result.logOdds = best.logOdds;
    result.secondLogOdds = second;
    return result;
  }

 private:
  Eigen::Vector3d offset(const PlacedObjects& placed, std::size_t i, std::size_t j) const
  {
    return map_[j]->object.center() - placed.centers[i];
  }

  /** S of doc/mathematics.md, (19.1). */
  Eigen::Matrix3d covariance(const PlacedObjects& placed, std::size_t i, std::size_t j) const
  {
    const double variance = options_.positionSigma * options_.positionSigma;
    return placed.covariances[i] + map_[j]->covariance.topLeftCorner<3, 3>() +
           variance * Eigen::Matrix3d::Identity();
  }

  double yawVariance(std::size_t i, std::size_t j) const
  {
    return local_[i]->covariance(3, 3) + map_[j]->covariance(3, 3) +
           options_.yawSigma * options_.yawSigma;
  }

  double yawOffset(const Place& place, std::size_t i, std::size_t j) const
  {
    return withinQuarterTurn(yawOf(*map_[j]) - yawOf(*local_[i]) - place.yaw);
  }

  /** ln of how much better "it is this one" explains where local object i is than "something like
   * it happens to be there", doc/mathematics.md, (19.2) and (19.3). It is 0 beyond the gate.
   * \param factor On the sigmas. */
  double evidence(const PlacedObjects& placed, std::size_t i, std::size_t j, double factor) const
  {
    const Eigen::Matrix3d S = factor * factor * covariance(placed, i, j);
    const Eigen::Vector3d d = offset(placed, i, j);
    if (d.squaredNorm() > kGate * S.trace()) return 0;  // as most: d^t S^-1 d >= |d|^2 / trace
    const double distance = d.dot(S.ldlt().solve(d));
    if (distance > kGate) return 0;
    const double logNormal =
        -std::log(2 * M_PI) - 0.5 * std::log(S.topLeftCorner<2, 2>().determinant());
    double sum = logNormal - 0.5 * distance - logDensity_[j] +
                 std::log(options_.knownShare / (1 - options_.knownShare));
    if (both_.bothHaveHeadings(i, j))
    {
      const double variance = factor * factor * yawVariance(i, j),
                   a = yawOffset(placed.place, i, j);
      const double logRatio = std::log(M_PI / 2) - 0.5 * std::log(2 * M_PI * variance);
      sum += std::clamp(logRatio - 0.5 * a * a / variance, -kMaxYawEvidence, kMaxYawEvidence);
    }
    return std::max(0.0, sum);
  }

  double coarseEvidence(const Place& place) const
  {
    const PlacedObjects placed(local_, place);
    double sum = 0;
    for (std::size_t i = 0; i < local_.size(); ++i)
    {
      double best = 0;
      for (const std::size_t j : both_.alike[i])
        best = std::max(best, evidence(placed, i, j, kCoarseFactor));
      sum += best;
    }
    return sum;
  }

  bool areDistinct(const Place& a, const Place& b) const
  {
    const Eigen::Vector3d shift = a.R() * middle_ + a.t - b.R() * middle_ - b.t;
    return shift.norm() > kOtherPlace || std::abs(mrpt::math::wrapToPi(a.yaw - b.yaw)) > kOtherYaw;
  }

  /** The most promising ones, best first; of those near each other two, as either may have
   * started with a pair that is none. */
  std::vector<Place> bestGuesses() const
  {
    constexpr int kOfOnePlace = 2;
    std::vector<std::pair<double, Place>> scored;
    for (const Place& place : guessPlaces(both_, options_))
      scored.emplace_back(coarseEvidence(place), place);
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

  /** The pairing with the most evidence, each object once. */
  Pairs pairsAt(const PlacedObjects& placed, double factor) const
  {
    const auto rows = static_cast<Eigen::Index>(local_.size());
    const auto columns = static_cast<Eigen::Index>(map_.size());
    Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(rows, columns + rows);  // or none
    for (std::size_t i = 0; i < local_.size(); ++i)
      for (const std::size_t j : both_.alike[i])
        cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            -evidence(placed, i, j, factor);
    Pairs pairs;
    const auto columnOf = optimalAssignment(cost);
    for (std::size_t i = 0; i < columnOf.size(); ++i)
      if (columnOf[i] < map_.size() &&
          cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(columnOf[i])) < 0)
        pairs.emplace_back(i, columnOf[i]);
    return pairs;
  }

  struct Normal
  {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
  };

  /** Weighted least squares of (shift, yaw) over the pairs, linearised at a place. */
  Normal normalEquations(const PlacedObjects& placed, const Pairs& pairs) const
  {
    Normal normal;
    for (const auto& [i, j] : pairs)
    {
      const Eigen::Vector3d q = placed.centers[i] - placed.place.t;
      Eigen::Matrix<double, 3, 4> J;  // of R p + t
      J << Eigen::Matrix3d::Identity(), Eigen::Vector3d(-q.y(), q.x(), 0);
      const Eigen::Matrix3d W = covariance(placed, i, j).inverse();
      normal.H += J.transpose() * W * J;
      normal.g += J.transpose() * W * offset(placed, i, j);
      if (!both_.bothHaveHeadings(i, j)) continue;
      const double variance = yawVariance(i, j), a = yawOffset(placed.place, i, j);
      if (a * a > kYawGate * variance) continue;  // it was turned since
      normal.H(3, 3) += 1 / variance;
      normal.g[3] += a / variance;
    }
    return normal;
  }

  void improve(Place& place, const Pairs& pairs) const
  {
    const Normal normal = normalEquations(PlacedObjects(local_, place), pairs);
    const Eigen::FullPivLU<Eigen::Matrix4d> lu(normal.H);
    if (!lu.isInvertible()) return;  // one object without a heading fixes no place
    const Eigen::Vector4d step = lu.solve(normal.g);
    place.t += step.head<3>();
    place.yaw = mrpt::math::wrapToPi(place.yaw + step[3]);
  }

  Hypothesis refined(const Place& guess) const
  {
    Hypothesis h;
    h.place = guess;
    for (int k = 0; k < kRefinements; ++k)
    {
      h.pairs = pairsAt(PlacedObjects(local_, h.place), k == 0 ? kCoarseFactor : 1);
      improve(h.place, h.pairs);
    }
    const PlacedObjects placed(local_, h.place);
    h.pairs = pairsAt(placed, 1);
    for (const auto& [i, j] : h.pairs) h.logOdds += evidence(placed, i, j, 1);
    h.logOdds += logUnknown(placed, h.pairs) - logPlaces(placed, h.pairs);
    return h;
  }

  /** ln of how likely the map lacks all local objects of its area, against which pairs are counted:
   * many strangers among the local objects speak against a place. */
  double logUnknown(const PlacedObjects& placed, const Pairs& pairs) const
  {
    std::vector<bool> counts(local_.size());
    for (std::size_t i = 0; i < local_.size(); ++i)
      counts[i] = bounds_.contains(placed.centers[i].head<2>());
    for (const auto& [i, j] : pairs) counts[i] = true;
    const auto n = std::count(counts.begin(), counts.end(), true);
    return static_cast<double>(n) * std::log(1 - options_.knownShare);
  }

  /** ln of the number of places that can be told apart, as finely as the pairs fix this one: so
   * many chances some objects had to fit by accident. */
  double logPlaces(const PlacedObjects& placed, const Pairs& pairs) const
  {
    const Normal normal = normalEquations(placed, pairs);
    Eigen::Matrix3d H;  // x, y, yaw
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) H(r, c) = normal.H(r == 2 ? 3 : r, c == 2 ? 3 : c);
    const double cells =
        area_ * 2 * M_PI * std::sqrt(std::max(0.0, H.determinant())) / std::pow(2 * M_PI, 1.5);
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
        [&](auto& p) { return both_.bothHaveHeadings(p.first, p.second); });
    return pairs.size() >= 2 &&
           pairs.size() + (heading ? 1 : 0) >= static_cast<std::size_t>(options_.minPairs);
  }

  const Objects &local_, &map_;
  const RelocalizationOptions& options_;
  Constellations both_;
  Eigen::AlignedBox2d bounds_;      //!< Of the map
  double area_ = 0;                 //!< Of the map [m^2]
  std::vector<double> logDensity_;  //!< Of objects with its label, for each of the map [ln 1/m^2]
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  //!< Of the local objects
};

}  // namespace

bool areAlike(
    const MapObject& a,
    const MapObject& b,
    const LabelTable& labels,
    const RelocalizationOptions& options)
{
  if (labelAgreement(a, b, labels) < options.minLabelAgreement) return false;
  const Eigen::Array3d ratio = orderedSizes(a).array() / orderedSizes(b).array();
  return ratio.log().abs().maxCoeff() <= options.maxSizeLogRatio;
}

std::optional<ConstellationMatch> matchConstellation(
    const std::vector<const MapObject*>& local,
    const std::vector<const MapObject*>& map,
    const LabelTable& labels,
    const RelocalizationOptions& options)
{
  if (local.empty() || map.empty()) return std::nullopt;
  return Matcher(local, map, labels, options).match();
}

}  // namespace quadmap
