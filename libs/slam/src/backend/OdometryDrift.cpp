#include "OdometryDrift.h"

#include <algorithm>

#include "OdometryChain.h"
#include "quadmap/geometry/PoseAngles.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
namespace
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

/** Covariance of (v, w) of one step, both in the map and about its origin.
 * \param step Its covariance, in MRPT's order, is that of the pose it leads to. */
Matrix6 ofStep(
    const mrpt::poses::CPose3D& T_map_from,
    const mrpt::poses::CPose3D& T_map_to,
    const mrpt::poses::CPose3DPDFGaussian& step)
{
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = T_map_from.getRotationMatrix().asEigen();
  J.bottomRightCorner<3, 3>() =
      T_map_to.getRotationMatrix().asEigen() * localTurnsPerAngle(step.mean);
  J.topRightCorner<3, 3>() = crossMatrix(positionOf(T_map_to)) * J.bottomRightCorner<3, 3>();
  return J * step.cov.asEigen() * J.transpose();
}

/** What (v, w) does to a place. */
Matrix36 moveOf(const Eigen::Vector3d& place)
{
  Matrix36 J;
  J << Eigen::Matrix3d::Identity(), -crossMatrix(place);
  return J;
}

}  // namespace

OdometryDrift::OdometryDrift(const std::vector<Keyframe>& keyframes, const StepNoise& noise)
{
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    if (const auto& step = keyframes[k].odometryStep; step && k > 0)
      sum += ofStep(
          keyframes[k - 1].T_map_robot, keyframes[k].T_map_robot,
          scaled(stiffAtRest(*step), noise));
    upTo_.push_back(sum);
  }
}

Eigen::Matrix3d OdometryDrift::covariance(const Moved& a, const Moved& b) const
{
  const std::size_t from = std::max(a.before, b.before), to = std::min(a.again, b.again);
  if (from >= to) return Eigen::Matrix3d::Zero();
  return moveOf(a.place) * (upTo_.at(to) - upTo_.at(from)) * moveOf(b.place).transpose();
}

}  // namespace quadmap
