#include <algorithm>
#include <cmath>
#include <optional>

#include "PointGraph.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
namespace
{
/** Information matrix of a chain of poses and the objects. Pose k has its own block, the one with
 * pose k + 1, and one with each object that it saw. */
template <int D>
struct Chain
{
  struct Link
  {
    Eigen::Index object = 0;  //!< Its first column
    Eigen::Matrix<double, kPoseIncrement<D>, D> information;
  };
  std::vector<PoseIncrementMatrix<D>> own, next;
  std::vector<std::vector<Link>> objects;
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
  chain.objects[sight.pose].push_back({o, byPose.transpose() * information * Rt});
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
  chain.objects.resize(poses.size());
  chain.border = kVague * Eigen::MatrixXd::Identity(n, n);
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (k == 0 || graph.posesFixed) chain.own[k] += kFixed * PoseIncrementMatrix<D>::Identity();
  for (std::size_t k = 0; k < graph.steps.size() && !graph.posesFixed; ++k)
    addStep<D>(poses[k], poses[k + 1], graph.steps[k], k, chain);
  for (const auto& sight : graph.sights)
    addSight<D>(poses[sight.pose], graph.objects[sight.object], sight, huber, chain);
  return chain;
}

/** The information of pose k when the poses before it are eliminated: pose k is then expressed by
 * pose k + 1 and the objects. */
template <int D>
class Elimination
{
 public:
  Elimination(const Chain<D>& chain, std::size_t k, const PoseIncrementMatrix<D>& own) :
      covariance_(own.inverse()),
      objects_(Eigen::MatrixXd::Zero(kPoseIncrement<D>, chain.border.cols()))
  {
    for (const auto& link : chain.objects[k])
      objects_.template middleCols<D>(link.object) += link.information;
  }

  /** The same of pose k + 1. */
  Elimination next(const Chain<D>& chain, std::size_t k) const
  {
    const auto& toNext = chain.next[k];
    Elimination later(chain, k + 1, chain.own[k + 1] - toNext.transpose() * covariance_ * toNext);
    later.objects_.noalias() -= toNext.transpose() * byObjects();
    return later;
  }

  /** Covariance of the pose on condition that pose k + 1 and the objects are known. */
  const PoseIncrementMatrix<D>& covariance() const { return covariance_; }
  Eigen::MatrixXd byObjects() const { return covariance_ * objects_; }
  /** What the pose tells of the objects. */
  void eliminateFrom(Eigen::MatrixXd& border) const
  {
    border.noalias() -= objects_.transpose() * byObjects();
  }

 private:
  PoseIncrementMatrix<D> covariance_;
  Eigen::MatrixXd objects_;
};

/** Marginals of pose k from those of pose k + 1 (none for the last pose) and of the objects. */
template <int D>
typename PointGraph<D>::PoseMarginal recover(
    const Chain<D>& chain,
    std::size_t k,
    const Elimination<D>& eliminated,
    const Eigen::MatrixXd& objects,
    const typename PointGraph<D>::PoseMarginal* later)
{
  typename PointGraph<D>::PoseMarginal result;
  const Eigen::MatrixXd U_o = eliminated.byObjects();
  result.poseObjects.noalias() = -U_o * objects;
  result.pose = eliminated.covariance() - result.poseObjects * U_o.transpose();
  if (!later) return result;
  const PoseIncrementMatrix<D> U_n = eliminated.covariance() * chain.next[k];
  result.poseObjects.noalias() -= U_n * later->poseObjects;
  const PoseIncrementMatrix<D> mixed = U_n * later->poseObjects * U_o.transpose();
  result.pose += mixed + mixed.transpose() + U_n * later->pose * U_n.transpose();
  return result;
}

}  // namespace

template <int D>
Eigen::MatrixXd PointGraph<D>::marginals(double huber, const PoseVisitor& visit) const
{
  // Each elimination has a row of all objects. Only some are kept, and those between are done
  // again.
  const std::size_t n = poses.size();
  const auto stride = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const Chain<D> chain = informationOf(*this, huber);
  Eigen::MatrixXd border = chain.border;
  std::vector<Elimination<D>> kept;
  Elimination<D> eliminated(chain, 0, chain.own[0]);
  for (std::size_t k = 0; k < n; ++k)
  {
    if (k > 0) eliminated = eliminated.next(chain, k - 1);
    if (k % stride == 0) kept.push_back(eliminated);
    eliminated.eliminateFrom(border);
  }
  const Eigen::MatrixXd objectCovariance = inverseOf<D>(border);
  if (!visit) return objectCovariance;

  std::optional<PoseMarginal> later;
  for (std::size_t part = kept.size(); part-- > 0;)
  {
    const std::size_t first = part * stride, end = std::min(n, first + stride);
    std::vector<Elimination<D>> between = {kept[part]};
    for (std::size_t k = first; k + 1 < end; ++k) between.push_back(between.back().next(chain, k));
    for (std::size_t k = end; k-- > first;)
    {
      later = recover<D>(chain, k, between[k - first], objectCovariance, later ? &*later : nullptr);
      if (!visit(k, *later, objectCovariance)) return objectCovariance;
    }
  }
  return objectCovariance;
}

template Eigen::MatrixXd PointGraph<2>::marginals(double, const PoseVisitor&) const;
template Eigen::MatrixXd PointGraph<3>::marginals(double, const PoseVisitor&) const;

}  // namespace quadmap
