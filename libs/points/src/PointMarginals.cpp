#include <cmath>

#include "PointGraph.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
namespace
{
/** Information matrix of a chain of poses and the objects. Pose k has three blocks: its own, the
 * one with pose k + 1, and the one with the objects. */
template <int D>
struct Chain
{
  std::vector<PoseIncrementMatrix<D>> own, next;
  std::vector<Eigen::MatrixXd> objects;
  Eigen::MatrixXd border;  //!< The block of the objects
};

/** Adds the step from pose k to the next one: doc/mathematics.md, (16.2). Its residual has a shift,
 * R_f^t (t_t - t_f) - t_m, and the turn from the measured pose to `to`. */
template <int D>
void addStep(
    const PointPose<D>& from,
    const PointPose<D>& to,
    const PointOdometry<D>& step,
    std::size_t k,
    Chain<D>& chain)
{
  PoseIncrementMatrix<D> byFrom = PoseIncrementMatrix<D>::Zero(),
                         byTo = PoseIncrementMatrix<D>::Zero();
  byFrom.template topLeftCorner<D, D>() = -from.R.transpose();
  byFrom.template topRightCorner<D, kTurn<D>>() =
      -from.R.transpose() * movedByTurn<D>(to.t - from.t);
  byTo.template topLeftCorner<D, D>() = from.R.transpose();
  if constexpr (D == 2)
  {
    byFrom(2, 2) = -1;
    byTo(2, 2) = 1;
  }
  else
  {
    byFrom.template bottomRightCorner<3, 3>() = -to.R.transpose();
    byTo.template bottomRightCorner<3, 3>() = to.R.transpose();
  }
  const PoseIncrementMatrix<D> information = step.covariance.inverse();
  chain.own[k] += byFrom.transpose() * information * byFrom;
  chain.own[k + 1] += byTo.transpose() * information * byTo;
  chain.next[k] += byFrom.transpose() * information * byTo;
}

template <int D>
void addSight(
    const PointPose<D>& pose,
    const PointVector<D>& object,
    const typename PointGraph<D>::Sight& sight,
    double huber,
    Chain<D>& chain)
{
  const PointMatrix<D> Rt = pose.R.transpose();
  const PointVector<D> r = Rt * (object - pose.t) - sight.position;
  PointMatrix<D> information = sight.covariance.inverse();
  const double sigmas = std::sqrt(r.dot(information * r));
  information *= RobustKernel::huber(huber).weight(sigmas);
  Eigen::Matrix<double, D, kPoseIncrement<D>> byPose;
  byPose.template leftCols<D>() = -Rt;
  byPose.template rightCols<kTurn<D>>() = -Rt * movedByTurn<D>(object - pose.t);
  const auto o = D * static_cast<Eigen::Index>(sight.object);
  chain.own[sight.pose] += byPose.transpose() * information * byPose;
  chain.objects[sight.pose].template middleCols<D>(o) += byPose.transpose() * information * Rt;
  chain.border.template block<D, D>(o, o) += Rt.transpose() * information * Rt;
}

template <int D>
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& m)
{
  return m.llt().solve(Eigen::MatrixXd::Identity(m.rows(), m.cols()));
}

template <int D>
Chain<D> informationOf(const PointGraph<D>& graph, double huber)
{
  constexpr double kFixed = 1e12;  // information of a fixed pose [1/m^2], [1/rad^2]
  constexpr double kVague = 1e-6;  // information of an object without sights [1/m^2]
  const auto n = D * static_cast<Eigen::Index>(graph.objects.size());
  const auto& poses = graph.poses;
  Chain<D> chain;
  chain.own.assign(poses.size(), PoseIncrementMatrix<D>::Zero());
  chain.next.assign(poses.size(), PoseIncrementMatrix<D>::Zero());
  chain.objects.assign(poses.size(), Eigen::MatrixXd::Zero(kPoseIncrement<D>, n));
  chain.border = kVague * Eigen::MatrixXd::Identity(n, n);
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (k == 0 || graph.posesFixed) chain.own[k] += kFixed * PoseIncrementMatrix<D>::Identity();
  for (std::size_t k = 0; k < graph.steps.size() && !graph.posesFixed; ++k)
    addStep<D>(poses[k], poses[k + 1], graph.steps[k], k, chain);
  for (const auto& sight : graph.sights)
    addSight<D>(poses[sight.pose], graph.objects[sight.object], sight, huber, chain);
  return chain;
}

/** Eliminates the poses one after the other: pose k is expressed by pose k + 1 and the objects.
 * \return The covariance of each pose on condition that these are known. */
template <int D>
std::vector<PoseIncrementMatrix<D>> eliminatePoses(Chain<D>& chain)
{
  const std::size_t last = chain.own.size() - 1;
  std::vector<PoseIncrementMatrix<D>> covariance(chain.own.size());
  for (std::size_t k = 0; k <= last; ++k)
  {
    covariance[k] = chain.own[k].inverse();
    const Eigen::MatrixXd byObjects = covariance[k] * chain.objects[k];
    chain.border.noalias() -= chain.objects[k].transpose() * byObjects;
    if (k == last) break;
    chain.own[k + 1] -= chain.next[k].transpose() * covariance[k] * chain.next[k];
    chain.objects[k + 1].noalias() -= chain.next[k].transpose() * byObjects;
  }
  return covariance;
}

}  // namespace

template <int D>
typename PointGraph<D>::Marginals PointGraph<D>::marginals(double huber) const
{
  Chain<D> chain = informationOf(*this, huber);
  const auto covariance = eliminatePoses(chain);

  // Going backwards, the covariances of pose k + 1 and of the objects are known.
  Marginals result;
  result.objects = inverseOf<D>(chain.border);
  result.pose.resize(poses.size());
  result.poseObjects.resize(poses.size());
  for (std::size_t k = poses.size(); k-- > 0;)
  {
    const Eigen::MatrixXd U_o = covariance[k] * chain.objects[k];
    result.poseObjects[k].noalias() = -U_o * result.objects;
    result.pose[k] = covariance[k] - result.poseObjects[k] * U_o.transpose();
    if (k + 1 == poses.size()) continue;
    const PoseIncrementMatrix<D> U_n = covariance[k] * chain.next[k];
    const Eigen::MatrixXd& later = result.poseObjects[k + 1];
    result.poseObjects[k].noalias() -= U_n * later;
    const PoseIncrementMatrix<D> mixed = U_n * later * U_o.transpose();
    result.pose[k] += mixed + mixed.transpose() + U_n * result.pose[k + 1] * U_n.transpose();
  }
  return result;
}

template PointGraph<2>::Marginals PointGraph<2>::marginals(double) const;
template PointGraph<3>::Marginals PointGraph<3>::marginals(double) const;

}  // namespace quadmap
