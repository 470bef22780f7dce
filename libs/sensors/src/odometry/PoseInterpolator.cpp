#include "odometry/PoseInterpolator.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/StepCovariance.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
constexpr double kSameTime = 1e-6;  // more than a tick of MRPT's clock, 1e-7 s [s]

mrpt::poses::CPose3D interpolate(
    const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b, double share)
{
  const Eigen::Matrix3d R_a = a.getRotationMatrix().asEigen(),
                        R_b = b.getRotationMatrix().asEigen();
  const Eigen::Matrix3d R =
      Eigen::Quaterniond(R_a).slerp(share, Eigen::Quaterniond(R_b)).toRotationMatrix();
  return mrpt::poses::CPose3D::FromRotationAndTranslation(
      R, ((1 - share) * positionOf(a) + share * positionOf(b)).eval());
}

CPose3DPDFGaussian interpolate(
    const CPose3DPDFGaussian& a, const CPose3DPDFGaussian& b, double share)
{
  CPose3DPDFGaussian result(interpolate(a.mean, b.mean, share));
  if (const auto added = addedCovariance(a, b))
    result.cov = covarianceAfterStep(a, result.mean - a.mean, share * *added);
  else
    result.cov = (1 - share) * a.cov.asEigen() + share * b.cov.asEigen();
  return result;
}

/** Why a covariance cannot be one. A variance of zero is legal: the robot does not move in this
 * direction, or the source does not say how far it errs there. */
std::optional<std::string> whyUnusable(const PoseCovariance& P)
{
  // Sources write up to 1e9 for directions of which they know nothing [m^2], [rad^2].
  constexpr double kMostVariance = 1e12;
  constexpr double kRoundedVariance = 1e-14;    // of sums [m^2], [rad^2]
  constexpr double kRoundedCorrelation = 1e-6;  // of numbers in single precision
  const double largest = P.cwiseAbs().maxCoeff(), least = P.diagonal().minCoeff();
  if (!(largest <= kMostVariance))
    return mrpt::format("has a covariance of %g, which is absurd", largest);
  if (least < -kRoundedVariance) return mrpt::format("has the negative variance %g", least);
  const Eigen::Matrix<double, 6, 1> toUnit =
      (P.diagonal().array() > kRoundedVariance)
          .select(P.diagonal().array().abs().max(kRoundedVariance).rsqrt(), 0);
  const PoseCovariance correlation = toUnit.asDiagonal() * P * toUnit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> eigen(correlation, Eigen::EigenvaluesOnly);
  if (eigen.eigenvalues().minCoeff() < -kRoundedCorrelation)
    return "has a covariance that is not positive";
  return std::nullopt;
}
}  // namespace

std::optional<std::string> whyUnusable(const CPose3DPDFGaussian& pose)
{
  if (const auto why = whyNoPose(pose.mean)) return why;
  return whyUnusable(PoseCovariance(pose.cov.asEigen()));
}

std::vector<StrayRecord> PoseInterpolator::add(const Stamped& next)
{
  if (const auto why = whyUnusable(next.pose)) throw std::runtime_error("the pose " + *why);
  if (const double back = clock_.lastBefore(next.time) - next.time; back > 0)
    throw std::runtime_error(mrpt::format("the time goes back by %.6f s", back));
  auto strays = clock_.advance(next.time, next.record);
  while (!poses_.empty() && poses_.back().time > next.time) poses_.pop_back();
  if (!poses_.empty() && next.time == poses_.back().time)
    poses_.back() = next;
  else
    poses_.push_back(next);
  return strays;
}

bool PoseInterpolator::reaches(double time) const { return latest() >= time - kSameTime; }

std::optional<CPose3DPDFGaussian> PoseInterpolator::at(double time, double maxGap) const
{
  const auto isBefore = [](const Stamped& s, double t) { return s.time < t; };
  const auto next = std::lower_bound(poses_.begin(), poses_.end(), time, isBefore);
  const auto same = [&](auto i) { return std::abs(i->time - time) <= kSameTime; };
  if (next != poses_.end() && same(next)) return next->pose;
  if (next == poses_.begin()) return std::nullopt;
  const auto previous = std::prev(next);
  if (same(previous)) return previous->pose;
  if (next == poses_.end() || next->time - previous->time > maxGap) return std::nullopt;
  const double share = (time - previous->time) / (next->time - previous->time);
  return interpolate(previous->pose, next->pose, share);
}

void PoseInterpolator::forgetBefore(double time)
{
  while (poses_.size() > 1 && poses_[1].time <= time - kSameTime) poses_.pop_front();
}

}  // namespace quadmap
