#include "quadmap/slam/relocalization/ConstellationMatch.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "quadmap/maps/Assignment.h"
#include "quadmap/maps/ObjectRules.h"

namespace quadmap
{
namespace
{
constexpr double kGate = 11.34;         // chi^2 of three degrees of freedom, 99 %
constexpr double kCoarseFactor = 2;     // on sigmas, while a place is only guessed from a pair
constexpr std::size_t kMaxPlaces = 60;  // guesses that are looked at closely
constexpr int kRefinements = 6;         // of a guess: pairs and place in turn
constexpr double kOtherPlace = 0.5;     // [m] at the objects: nearer ones are the same place
const double kOtherYaw = mrpt::DEG2RAD(20.0);
constexpr double kMargin = 0.5;        // around the objects of the map, for its area [m]
constexpr double kMaxYawEvidence = 2;  // bound of what one heading says for or against a pair

/** Shift and yaw of the local frame in the map. */
struct Place
{
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  double yaw = 0;

  Eigen::Matrix3d R() const
  {
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
};

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  //!< (local, map), indices

struct Hypothesis
{
  Place place;
  Pairs pairs;
  double logOdds = 0;
};

/** Angle to the nearest multiple of a quarter turn: which axis of a cuboid is x is arbitrary. */
double withinQuarterTurn(double angle) { return std::remainder(angle, M_PI / 2); }

Eigen::Vector3d orderedSizes(const MapObject& object)
{
  Eigen::Vector3d s = object.object.semiAxes();
  if (s.x() > s.y()) std::swap(s.x(), s.y());
  return s;
}

double yawOf(const MapObject& object) { return uprightStateOf(object.object)[3]; }

class Matcher
{
 public:
  using Objects = std::vector<const MapObject*>;

  Matcher(
      const Objects& local,
      const Objects& map,
      const LabelTable& labels,
      const RelocalizationOptions& options) :
      local_(local), map_(map), options_(options), alike_(local.size())
  {
    std::vector<std::size_t> rivals(map.size());
    for (std::size_t j = 0; j < map.size(); ++j)
      for (const MapObject* other : map)
        rivals[j] += labelAgreement(*map[j], *other, labels) >= options.minLabelAgreement;
    for (std::size_t i = 0; i < local.size(); ++i)
      for (std::size_t j = 0; j < map.size(); ++j)
        if (areAlike(*local[i], *map[j], labels, options)) alike_[i].push_back(j);
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
  bool bothHaveHeadings(std::size_t i, std::size_t j) const
  {
    return local_[i]->orientationDefined && map_[j]->orientationDefined;
  }

  Eigen::Vector3d offset(const Place& place, std::size_t i, std::size_t j) const
  {
    return map_[j]->object.center() - (place.R() * local_[i]->object.center() + place.t);
  }

  Eigen::Matrix3d covariance(const Place& place, std::size_t i, std::size_t j) const
  {
    const Eigen::Matrix3d R = place.R();
    const double variance = options_.positionSigma * options_.positionSigma;
    return R * local_[i]->covariance.topLeftCorner<3, 3>() * R.transpose() +
           map_[j]->covariance.topLeftCorner<3, 3>() + variance * Eigen::Matrix3d::Identity();
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
   * it happens to be there"; 0 when it is too far off.
   * \param factor On the sigmas. */
  double evidence(const Place& place, std::size_t i, std::size_t j, double factor) const
  {
    const Eigen::Matrix3d S = factor * factor * covariance(place, i, j);
    const Eigen::Vector3d d = offset(place, i, j);
    const double distance = d.dot(S.ldlt().solve(d));
    if (distance > kGate) return 0;
    const double logNormal =
        -std::log(2 * M_PI) - 0.5 * std::log(S.topLeftCorner<2, 2>().determinant());
    double sum = logNormal - 0.5 * distance - logDensity_[j] +
                 std::log(options_.knownShare / (1 - options_.knownShare));
    if (bothHaveHeadings(i, j))
    {
      const double variance = factor * factor * yawVariance(i, j), a = yawOffset(place, i, j);
      const double logRatio = std::log(M_PI / 2) - 0.5 * std::log(2 * M_PI * variance);
      sum += std::clamp(logRatio - 0.5 * a * a / variance, -kMaxYawEvidence, kMaxYawEvidence);
    }
    return std::max(0.0, sum);
  }

  /** Where two local objects are two of the map, or nothing when their distances differ. */
  std::optional<Place> placeOfTwo(
      std::size_t i1, std::size_t i2, std::size_t j1, std::size_t j2) const
  {
    const Eigen::Vector3d a1 = local_[i1]->object.center(), a2 = local_[i2]->object.center();
    const Eigen::Vector3d b1 = map_[j1]->object.center(), b2 = map_[j2]->object.center();
    const Eigen::Vector2d a = (a2 - a1).head<2>(), b = (b2 - b1).head<2>();
    const double sigma = std::sqrt(
        covariance({}, i1, j1).topLeftCorner<2, 2>().trace() / 2 +
        covariance({}, i2, j2).topLeftCorner<2, 2>().trace() / 2);
    if (std::abs(a.norm() - b.norm()) > 3 * sigma) return std::nullopt;
    if (std::min(a.norm(), b.norm()) < 3 * sigma) return std::nullopt;  // no direction
    Place place;
    place.yaw = mrpt::math::wrapToPi(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()));
    place.t = (b1 + b2) / 2 - place.R() * (a1 + a2) / 2;
    return place;
  }

  std::vector<Place> guesses() const
  {
    std::vector<Place> places;
    for (std::size_t i = 0; i < local_.size(); ++i)
      for (const std::size_t j : alike_[i])
      {
        if (bothHaveHeadings(i, j))
          for (int turn = 0; turn < 4; ++turn)
          {
            Place place;
            place.yaw = mrpt::math::wrapToPi(yawOf(*map_[j]) - yawOf(*local_[i]) + turn * M_PI / 2);
            place.t = map_[j]->object.center() - place.R() * local_[i]->object.center();
            places.push_back(place);
          }
        for (std::size_t i2 = i + 1; i2 < local_.size(); ++i2)
          for (const std::size_t j2 : alike_[i2])
            if (const auto place = j2 == j ? std::nullopt : placeOfTwo(i, i2, j, j2))
              places.push_back(*place);
      }
    return places;
  }

  double coarseEvidence(const Place& place) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < local_.size(); ++i)
    {
      double best = 0;
      for (const std::size_t j : alike_[i])
        best = std::max(best, evidence(place, i, j, kCoarseFactor));
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
    for (const Place& place : guesses()) scored.emplace_back(coarseEvidence(place), place);
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
  Pairs pairsAt(const Place& place, double factor) const
  {
    const auto rows = static_cast<Eigen::Index>(local_.size());
    const auto columns = static_cast<Eigen::Index>(map_.size());
    Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(rows, columns + rows);  // or none
    for (std::size_t i = 0; i < local_.size(); ++i)
      for (const std::size_t j : alike_[i])
        cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            -evidence(place, i, j, factor);
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
  Normal normalEquations(const Place& place, const Pairs& pairs) const
  {
    Normal normal;
    for (const auto& [i, j] : pairs)
    {
      const Eigen::Vector3d q = place.R() * local_[i]->object.center();
      Eigen::Matrix<double, 3, 4> J;  // of R p + t
      J << Eigen::Matrix3d::Identity(), Eigen::Vector3d(-q.y(), q.x(), 0);
      const Eigen::Matrix3d W = covariance(place, i, j).inverse();
      normal.H += J.transpose() * W * J;
      normal.g += J.transpose() * W * offset(place, i, j);
      if (!bothHaveHeadings(i, j)) continue;
      const double variance = yawVariance(i, j), a = yawOffset(place, i, j);
      if (a * a > kGate * variance) continue;  // turned since
      normal.H(3, 3) += 1 / variance;
      normal.g[3] += a / variance;
    }
    return normal;
  }

  void improve(Place& place, const Pairs& pairs) const
  {
    const Normal normal = normalEquations(place, pairs);
    const Eigen::FullPivLU<Eigen::Matrix4d> lu(normal.H);
    if (!lu.isInvertible()) return;  // one object without heading
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
      h.pairs = pairsAt(h.place, k == 0 ? kCoarseFactor : 1);
      improve(h.place, h.pairs);
    }
    h.pairs = pairsAt(h.place, 1);
    for (const auto& [i, j] : h.pairs) h.logOdds += evidence(h.place, i, j, 1);
    h.logOdds += logUnknown(h) - logPlaces(h);
    return h;
  }

  /** ln of how likely the map lacks all local objects of its area, against which pairs are counted:
   * many strangers among the local objects speak against a place. */
  double logUnknown(const Hypothesis& h) const
  {
    std::vector<bool> counts(local_.size());
    for (std::size_t i = 0; i < local_.size(); ++i)
    {
      const Eigen::Vector3d p = h.place.R() * local_[i]->object.center() + h.place.t;
      counts[i] = bounds_.contains(p.head<2>());
    }
    for (const auto& [i, j] : h.pairs) counts[i] = true;
    const auto n = std::count(counts.begin(), counts.end(), true);
    return static_cast<double>(n) * std::log(1 - options_.knownShare);
  }

  /** ln of the number of places that can be told apart, as finely as the pairs fix this one: so
   * many chances some objects had to fit by accident. */
  double logPlaces(const Hypothesis& h) const
  {
    const Normal normal = normalEquations(h.place, h.pairs);
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
        pairs.begin(), pairs.end(), [&](auto& p) { return bothHaveHeadings(p.first, p.second); });
    return pairs.size() >= 2 &&
           pairs.size() + (heading ? 1 : 0) >= static_cast<std::size_t>(options_.minPairs);
  }

  const Objects &local_, &map_;
  const RelocalizationOptions& options_;
  std::vector<std::vector<std::size_t>> alike_;  //!< Objects of the map, for each local one
  Eigen::AlignedBox2d bounds_;                   //!< Of the map
  double area_ = 0;                              //!< Of the map [m^2]
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
