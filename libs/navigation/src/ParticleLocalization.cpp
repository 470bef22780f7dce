#include "quadmap/navigation/ParticleLocalization.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "FullestPlace.h"
#include "ParallelRanges.h"

namespace quadmap
{
using mrpt::math::wrapToPi;
using mrpt::poses::CPose3D;

namespace
{
/** How often the mean moves to the mean of what is near it, at most; it rests after a few. */
constexpr int kMeanShifts = 5;

/** Lower triangle L with L Lt = S, for S without negative eigenvalues. */
template <int N>
Eigen::Matrix<double, N, N> squareRoot(const Eigen::Matrix<double, N, N>& S)
{
  constexpr double kLeast = 1e-12;  // so that a variance of zero has a root
  return (S + kLeast * Eigen::Matrix<double, N, N>::Identity()).llt().matrixL();
}

/** Index of the element in which a share of the sum ends. \param sums Running sums, the last > 0.
 */
std::size_t drawnIndex(const std::vector<double>& sums, double share)
{
  const auto found = std::upper_bound(sums.begin(), sums.end(), share * sums.back());
  return std::min(static_cast<std::size_t>(found - sums.begin()), sums.size() - 1);
}

std::vector<double> runningSums(const std::vector<double>& values)
{
  std::vector<double> sums(values.size());
  std::partial_sum(values.begin(), values.end(), sums.begin());
  return sums;
}

}  // namespace

StartRegion regionOf(const CQuadricObjectMap& map, double margin)
{
  if (map.confirmedObjects().empty()) throw std::invalid_argument("the map has no objects");
  const auto box = map.boundingBox();
  const Eigen::Vector2d around(margin, margin);
  return {
      Eigen::Vector2d(box.min.x, box.min.y) - around,
      Eigen::Vector2d(box.max.x, box.max.y) + around};
}

ParticleLocalization::ParticleLocalization(
    const LocalizationOptions& options,
    const StartRegion& region,
    const CPose3D& T_odom_robot,
    std::size_t threads) :
    options_(options),
    threads_(threads),
    random_(static_cast<std::uint32_t>(options.seed)),
    particles_(static_cast<std::size_t>(options.particles)),
    pitch_(T_odom_robot.pitch()),
    roll_(T_odom_robot.roll())
{
  for (LevelPose& p : particles_)
  {
    p.position.x() = random_.drawUniform(region.lower.x(), region.upper.x());
    p.position.y() = random_.drawUniform(region.lower.y(), region.upper.y());
    p.position.z() =
        T_odom_robot.z() + options_.startHeightSigma * random_.drawGaussian1D_normalized();
    p.yaw = random_.drawUniform(-M_PI, M_PI);
  }
  estimate_ = estimateOf(std::vector<double>(particles_.size(), 1.0));
}

void ParticleLocalization::predict(
    const mrpt::poses::CPose3DPDFGaussian& step, const CPose3D& T_odom_robot)
{
  const Eigen::Matrix4d L = squareRoot<4>(step.cov.asEigen().topLeftCorner<4, 4>());
  for (LevelPose& p : particles_)
  {
    Eigen::Vector4d error;
    for (Eigen::Index i = 0; i < 4; ++i) error[i] = random_.drawGaussian1D_normalized();
    error = L * error;
    const CPose3D moved =
        CPose3D(p.position.x(), p.position.y(), p.position.z(), p.yaw, pitch_, roll_) +
        CPose3D(
            step.mean.x() + error[0], step.mean.y() + error[1], step.mean.z() + error[2],
            step.mean.yaw() + error[3], step.mean.pitch(), step.mean.roll());
    p.position = {moved.x(), moved.y(), moved.z()};
    p.yaw = moved.yaw();
  }
  pitch_ = T_odom_robot.pitch();
  roll_ = T_odom_robot.roll();
}

void ParticleLocalization::update(const FrameLikelihood& seen)
{
  const std::vector<double> weights = weigh(seen);
  estimate_ = estimateOf(weights);
  resample(weights, seen);
}

/** The weights (14.4), the largest one being 1. */
std::vector<double> ParticleLocalization::weigh(const FrameLikelihood& seen) const
{
  std::vector<double> weights(particles_.size());
  forEachInParallel(
      particles_.size(), threads_, [&](std::size_t i) { weights[i] = seen.at(particles_[i]); });
  const double best = *std::max_element(weights.begin(), weights.end());
  for (double& w : weights) w = std::exp(w - best);
  return weights;
}

/** Systematic resampling, and (14.5) for the share that is drawn anew. */
void ParticleLocalization::resample(const std::vector<double>& weights, const FrameLikelihood& seen)
{
  std::vector<double> agreements;
  for (const auto& pairing : seen.pairings())
    agreements.push_back(seen.boxes()[pairing.box].hasPlace ? pairing.agreement : 0.0);
  const auto pairingSums = runningSums(agreements);
  const bool canDraw = !pairingSums.empty() && pairingSums.back() > 0;
  const double share = options_.doubtShare + (options_.searchShare - options_.doubtShare) *
                                                 (1 - estimate_.share);  // (14.6)
  const std::size_t count = particles_.size();
  const auto fresh = static_cast<std::size_t>(canDraw ? share * static_cast<double>(count) : 0.0);

  const auto sums = runningSums(weights);
  const std::size_t kept = count - fresh;
  const double offset = random_.drawUniform(0.0, 1.0);
  std::vector<LevelPose> drawn;
  drawn.reserve(count);
  for (std::size_t i = 0; i < kept; ++i)
    drawn.push_back(particles_[drawnIndex(
        sums, (static_cast<double>(i) + offset) / static_cast<double>(kept))]);
  while (drawn.size() < count) drawn.push_back(drawnFrom(seen, pairingSums));
  particles_ = std::move(drawn);
}

Eigen::Vector3d ParticleLocalization::normalVector()
{
  Eigen::Vector3d v;
  for (Eigen::Index i = 0; i < 3; ++i) v[i] = random_.drawGaussian1D_normalized();
  return v;
}

/** A pose from which one of the boxes shows an object that it may show, (14.5). */
LevelPose ParticleLocalization::drawnFrom(
    const FrameLikelihood& seen, const std::vector<double>& pairingSums)
{
  const auto& pairing = seen.pairings()[drawnIndex(pairingSums, random_.drawUniform(0.0, 1.0))];
  const ObjectView& view = seen.boxes()[pairing.box].view;
  const auto& target = seen.targets()[pairing.target];
  LevelPose pose;
  pose.yaw = random_.drawUniform(-M_PI, M_PI);
  if (view.complete && view.yawDefined && target.orientationDefined)
  {
    const double turns = std::floor(random_.drawUniform(0.0, 4.0));  // a heading is modulo 90 deg
    const double sigma = std::sqrt(view.yawSigma * view.yawSigma + target.yawVariance);
    pose.yaw = wrapToPi(
        target.yaw - view.yaw + 0.5 * M_PI * turns + sigma * random_.drawGaussian1D_normalized());
  }
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d S = R * view.centerCovariance * R.transpose() + target.covariance;
  pose.position = target.object.center() - R * view.center + squareRoot<3>(S) * normalVector();
  return pose;
}

/** Mean and spread of the particles around the best place, (14.7). */
LocalizationEstimate ParticleLocalization::estimateOf(const std::vector<double>& weights) const
{
  LevelPose mean = fullestPlace(particles_, weights, options_.placeRadius, options_.placeAngle);
  double near = 0;
  Eigen::Vector4d spread = Eigen::Vector4d::Zero();
  for (int round = 0; round < kMeanShifts; ++round)
  {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero(), squares = Eigen::Vector4d::Zero();
    near = 0;
    for (std::size_t i = 0; i < particles_.size(); ++i)
    {
      Eigen::Vector4d off;
      off << particles_[i].position - mean.position, wrapToPi(particles_[i].yaw - mean.yaw);
      if (off.head<2>().norm() > options_.placeRadius || std::abs(off[3]) > options_.placeAngle)
        continue;
      near += weights[i];
      sum += weights[i] * off;
      squares += weights[i] * off.cwiseAbs2();
    }
    if (!(near > 0)) break;
    sum /= near;
    spread = (squares / near - sum.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    mean.position += sum.head<3>();
    mean.yaw = wrapToPi(mean.yaw + sum[3]);
  }
  LocalizationEstimate found;
  found.T_map_robot =
      CPose3D(mean.position.x(), mean.position.y(), mean.position.z(), mean.yaw, pitch_, roll_);
  found.share = near / std::accumulate(weights.begin(), weights.end(), 0.0);
  found.sigma = std::max(spread[0], spread[1]);
  found.yawSigma = spread[3];
  found.isLocalised = found.share >= options_.localisedShare &&
                      found.sigma < options_.localisedSigma &&
                      found.yawSigma < options_.localisedAngle;
  return found;
}

}  // namespace quadmap
