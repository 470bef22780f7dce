#include "quadmap/evaluation/TrajectoryAlignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
/** Weight of the bodies' axes against positions: doc/mathematics.md, section 20 [m^2]. */
constexpr double kOrientationWeight = 1.0;

/** The truth's axes are taken as optical only when the disagreement is less than this share. */
constexpr double kClearlyBetter = 0.25;

Eigen::Matrix3d rotation(const mrpt::poses::CPose3D& T) { return T.getRotationMatrix().asEigen(); }

struct Centroids
{
  Eigen::Vector3d truth = Eigen::Vector3d::Zero(), estimated = Eigen::Vector3d::Zero();
};

Centroids centroidsOf(const std::vector<PosePair>& pairs)
{
  Centroids mean;
  for (const auto& pair : pairs)
  {
    mean.truth += positionOf(pair.T_truth_body);
    mean.estimated += positionOf(pair.T_estimated_body);
  }
  mean.truth /= static_cast<double>(pairs.size());
  mean.estimated /= static_cast<double>(pairs.size());
  return mean;
}

/** sum (p_truth - mean) (p_estimated - mean)^t / n [m^2]: doc/mathematics.md, (20.1). */
Eigen::Matrix3d crossCovariance(const std::vector<PosePair>& pairs, const Centroids& mean)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& pair : pairs)
    sum += (positionOf(pair.T_truth_body) - mean.truth) *
           (positionOf(pair.T_estimated_body) - mean.estimated).transpose();
  return sum / static_cast<double>(pairs.size());
}

/** sum R_truth B^t R_estimated^t / n. */
Eigen::Matrix3d axesCovariance(const std::vector<PosePair>& pairs, const Eigen::Matrix3d& B)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& pair : pairs)
    sum +=
        rotation(pair.T_truth_body) * B.transpose() * rotation(pair.T_estimated_body).transpose();
  return sum / static_cast<double>(pairs.size());
}

/** The rotation R that maximises tr(R^t M), by singular values: doc/mathematics.md, (20.1). */
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1, 1, sign < 0 ? -1 : 1).asDiagonal() *
         svd.matrixV().transpose();
}

/** Rotation from positions and axes together, see alignTrajectories(). */
Eigen::Matrix3d rotationWithOrientations(
    const std::vector<PosePair>& pairs, const Eigen::Matrix3d& positions)
{
  // The largest possible trace means perfect agreement. The difference from it is the disagreement.
  const double perfect =
      Eigen::JacobiSVD<Eigen::Matrix3d>(positions).singularValues().sum() + 3 * kOrientationWeight;
  const auto solve = [&](const Eigen::Matrix3d& B, double& disagreement)
  {
    const Eigen::Matrix3d M = positions + kOrientationWeight * axesCovariance(pairs, B);
    const Eigen::Matrix3d R = nearestRotation(M);
    disagreement = perfect - (R.transpose() * M).trace();
    return R;
  };
  double sameBody = 0, optical = 0;
  const Eigen::Matrix3d R_sameBody = solve(Eigen::Matrix3d::Identity(), sameBody);
  const Eigen::Matrix3d R_optical = solve(rotation(T_sensor_optical()), optical);
  return optical < kClearlyBetter * sameBody - 1e-9 ? R_optical : R_sameBody;
}

mrpt::poses::CPose3D poseFrom(const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
{
  mrpt::math::CMatrixDouble44 T;
  T.setIdentity();
  T.asEigen().topLeftCorner<3, 3>() = R;
  T.asEigen().topRightCorner<3, 1>() = t;
  return mrpt::poses::CPose3D(T);
}

const StampedPose* nearestInTime(const Trajectory& sorted, double time)
{
  const auto after = std::lower_bound(
      sorted.begin(), sorted.end(), time,
      [](const StampedPose& sample, double t) { return sample.time < t; });
  if (after == sorted.begin()) return after == sorted.end() ? nullptr : &*after;
  const auto before = after - 1;
  if (after == sorted.end() || time - before->time <= after->time - time) return &*before;
  return &*after;
}

Trajectory sortedByTime(Trajectory trajectory)
{
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.time < b.time; });
  return trajectory;
}

void requirePairs(const std::vector<PosePair>& pairs)
{
  if (pairs.empty()) throw std::invalid_argument("trajectories: no pair of poses to compare");
}
}  // namespace

std::vector<PosePair> pairByTime(
    const Trajectory& truth, const Trajectory& estimated, double maxTimeDifference)
{
  const Trajectory sortedTruth = sortedByTime(truth), sortedEstimated = sortedByTime(estimated);
  const bool truthIsShorter = truth.size() < estimated.size();
  const Trajectory& shorter = truthIsShorter ? sortedTruth : sortedEstimated;
  const Trajectory& longer = truthIsShorter ? sortedEstimated : sortedTruth;

  std::vector<PosePair> pairs;
  pairs.reserve(shorter.size());
  for (const StampedPose& pose : shorter)
  {
    const StampedPose* nearest = nearestInTime(longer, pose.time);
    if (!nearest || std::abs(nearest->time - pose.time) > maxTimeDifference) continue;
    if (truthIsShorter)
      pairs.push_back({pose.pose, nearest->pose, nearest->time});
    else
      pairs.push_back({nearest->pose, pose.pose, pose.time});
  }
  return pairs;
}

TrajectoryAlignment alignTrajectories(const std::vector<PosePair>& pairs)
{
  requirePairs(pairs);
  const Centroids mean = centroidsOf(pairs);
  const Eigen::Matrix3d H = crossCovariance(pairs, mean);
  const auto aligned = [&](const Eigen::Matrix3d& R)
  { return poseFrom(R, mean.truth - R * mean.estimated); };

  TrajectoryAlignment result;
  result.secondSpread = std::sqrt(Eigen::JacobiSVD<Eigen::Matrix3d>(H).singularValues()[1]);
  result.T_truth_estimated = aligned(nearestRotation(H));
  // Section 20 of doc/mathematics.md, "Alignment".
  result.leastSpread =
      std::max(kMinSecondSpread, kMinSpreadPerError * ateRmse(pairs, result.T_truth_estimated));
  if (result.secondSpread >= result.leastSpread) return result;
  result.source = AlignmentSource::Orientations;
  result.T_truth_estimated = aligned(rotationWithOrientations(pairs, H));
  return result;
}

mrpt::poses::CPose3D alignPositions(const std::vector<PosePair>& pairs)
{
  requirePairs(pairs);
  const Centroids mean = centroidsOf(pairs);
  const Eigen::Matrix3d R = nearestRotation(crossCovariance(pairs, mean));
  return poseFrom(R, mean.truth - R * mean.estimated);
}

double ateRmse(const std::vector<PosePair>& pairs, const mrpt::poses::CPose3D& T_truth_estimated)
{
  requirePairs(pairs);
  double sum = 0;
  for (const auto& pair : pairs)
    sum += (positionOf(pair.T_truth_body) - positionOf(T_truth_estimated + pair.T_estimated_body))
               .squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace quadmap
