#include "PlaceEvidence.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "quadmap/constellation/ConstellationMatch.h"
#include "quadmap/estimation/Assignment.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
constexpr double kYawGate = 6.63;      // chi^2 of one degree of freedom, 99 %
constexpr double kMargin = 0.5;        // around the objects of the map, for its area [m]
constexpr double kMaxYawEvidence = 2;  // bound of what one heading says for or against a pair

/** Angle to the nearest multiple of a quarter turn [rad]. Which axis of a cuboid is called x is
 * arbitrary. */
double withinQuarterTurn(double angle) { return std::remainder(angle, M_PI / 2); }

}  // namespace

PlacedObjects::PlacedObjects(const Constellations::Objects& local, const Place& at) : place(at)
{
  const Eigen::Matrix3d R = at.R();
  for (const MapObject* object : local)
  {
    centers.emplace_back(R * object->object.center() + at.t);
    covariances.emplace_back(R * object->covariance.topLeftCorner<3, 3>() * R.transpose());
  }
}

PlaceEvidence::PlaceEvidence(
    const Constellations::Objects& local,
    const Constellations::Objects& map,
    const LabelTable& labels,
    const ConstellationOptions& options) :
    options_(options), both_{local, map, std::vector<std::vector<std::size_t>>(local.size())}
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
  const double area = bounds_.volume();
  for (const std::size_t n : rivals)
    logDensity_.push_back(std::log(static_cast<double>(std::max<std::size_t>(1, n)) / area));
}

Eigen::Vector3d PlaceEvidence::offset(
    const PlacedObjects& placed, std::size_t i, std::size_t j) const
{
  return both_.map[j]->object.center() - placed.centers[i];
}

/** S of doc/mathematics.md, (19.1). */
Eigen::Matrix3d PlaceEvidence::covariance(
    const PlacedObjects& placed, std::size_t i, std::size_t j) const
{
  const double variance = options_.positionSigma * options_.positionSigma;
  return placed.covariances[i] + both_.map[j]->covariance.topLeftCorner<3, 3>() +
         variance * Eigen::Matrix3d::Identity();
}

double PlaceEvidence::yawVariance(std::size_t i, std::size_t j) const
{
  return both_.local[i]->covariance(3, 3) + both_.map[j]->covariance(3, 3) +
         options_.yawSigma * options_.yawSigma;
}

double PlaceEvidence::yawOffset(const Place& place, std::size_t i, std::size_t j) const
{
  return withinQuarterTurn(yawOf(*both_.map[j]) - yawOf(*both_.local[i]) - place.yaw);
}

double PlaceEvidence::of(
    const PlacedObjects& placed, std::size_t i, std::size_t j, double factor) const
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
    const double variance = factor * factor * yawVariance(i, j), a = yawOffset(placed.place, i, j);
    const double logRatio = std::log(M_PI / 2) - 0.5 * std::log(2 * M_PI * variance);
    sum += std::clamp(logRatio - 0.5 * a * a / variance, -kMaxYawEvidence, kMaxYawEvidence);
  }
  return std::max(0.0, sum);
}

double PlaceEvidence::coarse(const Place& place) const
{
  const PlacedObjects placed(both_.local, place);
  double sum = 0;
  for (std::size_t i = 0; i < both_.local.size(); ++i)
  {
    double best = 0;
    for (const std::size_t j : both_.alike[i])
      best = std::max(best, of(placed, i, j, kCoarseFactor));
    sum += best;
  }
  return sum;
}

Pairs PlaceEvidence::pairsAt(const PlacedObjects& placed, double factor) const
{
  const auto rows = static_cast<Eigen::Index>(both_.local.size());
  const auto columns = static_cast<Eigen::Index>(both_.map.size());
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(rows, columns + rows);  // or none
  for (std::size_t i = 0; i < both_.local.size(); ++i)
    for (const std::size_t j : both_.alike[i])
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = -of(placed, i, j, factor);
  Pairs pairs;
  const auto columnOf = optimalAssignment(cost);
  for (std::size_t i = 0; i < columnOf.size(); ++i)
    if (columnOf[i] < both_.map.size() &&
        cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(columnOf[i])) < 0)
      pairs.emplace_back(i, columnOf[i]);
  return pairs;
}

PlaceEvidence::Gap PlaceEvidence::gap(
    const PlacedObjects& placed, std::size_t i, std::size_t j) const
{
  const Eigen::Vector3d q = placed.centers[i] - placed.place.t;
  Gap gap{offset(placed, i, j), {}, covariance(placed, i, j)};
  gap.J << Eigen::Matrix3d::Identity(), Eigen::Vector3d(-q.y(), q.x(), 0);  // of R p + t
  return gap;
}

PlaceEvidence::Normal PlaceEvidence::normalEquations(
    const PlacedObjects& placed, const Pairs& pairs) const
{
  Normal normal;
  for (const auto& [i, j] : pairs)
  {
    const Gap pair = gap(placed, i, j);
    const Eigen::Matrix<double, 4, 3> JtW = pair.J.transpose() * pair.S.inverse();
    normal.H += JtW * pair.J;
    normal.g += JtW * pair.d;
    if (!both_.bothHaveHeadings(i, j)) continue;
    const double variance = yawVariance(i, j), a = yawOffset(placed.place, i, j);
    if (a * a > kYawGate * variance) continue;  // it was turned since
    normal.H(3, 3) += 1 / variance;
    normal.g[3] += a / variance;
  }
  return normal;
}

std::optional<PlaceEvidence::Normal::Solution> PlaceEvidence::Normal::solved() const
{
  const Eigen::FullPivLU<Eigen::Matrix4d> lu(H);
  if (!lu.isInvertible()) return std::nullopt;
  return Solution{lu.solve(g), lu.inverse()};
}

Place PlaceEvidence::improved(const Place& place, const Pairs& pairs) const
{
  const auto found = normalEquations(PlacedObjects(both_.local, place), pairs).solved();
  if (!found) return place;
  return {place.t + found->step.head<3>(), mrpt::math::wrapToPi(place.yaw + found->step[3])};
}

}  // namespace quadmap
