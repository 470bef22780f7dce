#include "PointFilter.h"

namespace quadmap
{
namespace
{
/** Derivative of an object's position in the robot's frame by the increment of the pose. */
template <int D>
Eigen::Matrix<double, D, kPoseIncrement<D>> byPose(
    const PointPose<D>& pose, const PointVector<D>& object)
{
  Eigen::Matrix<double, D, kPoseIncrement<D>> J;
  J.template leftCols<D>() = -pose.R.transpose();
  J.template rightCols<kTurn<D>>() = -pose.R.transpose() * movedByTurn<D>(object - pose.t);
  return J;
}

}  // namespace

template <int D>
PointInnovation<D> innovationOf(const PointBelief<D>& belief, const PointMeasurement<D>& z)
{
  const auto J = byPose<D>(belief.pose, belief.object);
  const PointMatrix<D> Rt = belief.pose.R.transpose();
  const PointMatrix<D> cross = J * belief.poseObject * Rt.transpose();
  PointInnovation<D> result;
  result.difference = z.position - belief.pose.inverse() * belief.object;
  result.state = J * belief.poseCovariance * J.transpose() + cross + cross.transpose() +
                 Rt * belief.objectCovariance * Rt.transpose();
  result.covariance = result.state + z.covariance;
  return result;
}

template <int D>
PointMatrix<D> PointFilter<D>::objectCovariance(std::size_t i) const
{
  return P_.template block<D, D>(row(i), row(i));
}

template <int D>
void PointFilter<D>::reset(
    const PointPose<D>& pose, std::vector<PointVector<D>> points, Eigen::MatrixXd covariance)
{
  pose_ = pose;
  points_ = std::move(points);
  P_ = std::move(covariance);
}

template <int D>
void PointFilter<D>::predict(const PointOdometry<D>& step)
{
  PoseIncrementMatrix<D> F = PoseIncrementMatrix<D>::Identity(),
                         G = PoseIncrementMatrix<D>::Identity();
  F.template topRightCorner<D, kTurn<D>>() = movedByTurn<D>(pose_.R * step.T_from_to.t);
  G.template topLeftCorner<D, D>() = pose_.R;
  pose_ = pose_ * step.T_from_to;
  if constexpr (D == 3) G.template bottomRightCorner<3, 3>() = pose_.R;
  const Eigen::Index others = P_.cols() - kP;
  P_.template topLeftCorner<kP, kP>() = (F * P_.template topLeftCorner<kP, kP>() * F.transpose() +
                                         G * step.covariance * G.transpose())
                                            .eval();
  P_.topRightCorner(kP, others) = (F * P_.topRightCorner(kP, others)).eval();
  P_.bottomLeftCorner(others, kP) = P_.topRightCorner(kP, others).transpose();
}

template <int D>
PointInnovation<D> PointFilter<D>::innovation(
    std::size_t object, const PointMeasurement<D>& z) const
{
  return innovationOf<D>(
      {pose_, points_[object], P_.template topLeftCorner<kP, kP>(),
       P_.template block<kP, D>(0, row(object)), objectCovariance(object)},
      z);
}

template <int D>
void PointFilter<D>::update(std::size_t object, const PointMeasurement<D>& z)
{
  const PointInnovation<D> seen = innovation(object, z);
  const Eigen::MatrixXd PHt = P_.leftCols(kP) * byPose<D>(pose_, points_[object]).transpose() +
                              P_.middleCols(row(object), D) * pose_.R;
  const Eigen::MatrixXd gain = PHt * seen.covariance.inverse();
  const Eigen::VectorXd increment = gain * seen.difference;
  P_.noalias() -= gain * PHt.transpose();
  P_ = (0.5 * (P_ + P_.transpose())).eval();

  pose_.t += increment.template head<D>();
  pose_.R = rotationBy<D>(increment.template segment<kTurn<D>>(D)) * pose_.R;
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i] += increment.template segment<D>(row(i));
}

template <int D>
void PointFilter<D>::add(const PointMeasurement<D>& z)
{
  Eigen::Matrix<double, D, kP> J;
  J.template leftCols<D>().setIdentity();
  J.template rightCols<kTurn<D>>() = movedByTurn<D>(pose_.R * z.position);
  const Eigen::Index n = P_.rows();
  const Eigen::MatrixXd cross = J * P_.topRows(kP);
  P_.conservativeResize(n + D, n + D);
  P_.bottomLeftCorner(D, n) = cross;
  P_.topRightCorner(n, D) = cross.transpose();
  P_.bottomRightCorner(D, D) =
      cross.leftCols(kP) * J.transpose() + pose_.R * z.covariance * pose_.R.transpose();
  points_.push_back(pose_ * z.position);
}

template <int D>
void PointFilter<D>::remove(std::size_t object)
{
  const Eigen::Index n = P_.rows(), first = row(object), after = first + D;
  Eigen::MatrixXd P(n - D, n - D);
  P.topLeftCorner(first, first) = P_.topLeftCorner(first, first);
  P.topRightCorner(first, n - after) = P_.topRightCorner(first, n - after);
  P.bottomLeftCorner(n - after, first) = P_.bottomLeftCorner(n - after, first);
  P.bottomRightCorner(n - after, n - after) = P_.bottomRightCorner(n - after, n - after);
  P_ = std::move(P);
  points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(object));
}

template PointInnovation<2> innovationOf<2>(const PointBelief<2>&, const PointMeasurement<2>&);
template PointInnovation<3> innovationOf<3>(const PointBelief<3>&, const PointMeasurement<3>&);
template class PointFilter<2>;
template class PointFilter<3>;

}  // namespace quadmap
