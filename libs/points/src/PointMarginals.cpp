#include <algorithm>
#include <cmath>
#include <optional>

#include "PointFactors.h"
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

/** Adds the step from pose k to the next one. */
template <int D>
void addStep(const LinearisedStep<D>& step, std::size_t k, Chain<D>& chain)
{
  chain.own[k] += step.byFrom.transpose() * step.byFrom;
  chain.own[k + 1] += step.byTo.transpose() * step.byTo;
  chain.next[k] += step.byFrom.transpose() * step.byTo;
}

template <int D>
void addSight(
    const LinearisedSight<D>& sight,
    std::size_t pose,
    std::size_t object,
    double huber,
    Chain<D>& chain)
{
  const double weight = RobustKernel::huber(huber).weight(sight.r.norm());
  const auto o = D * static_cast<Eigen::Index>(object);
  chain.own[pose] += weight * sight.byPose.transpose() * sight.byPose;
  chain.objects[pose].push_back({o, weight * sight.byPose.transpose() * sight.byObject});
  chain.border.template block<D, D>(o, o) += weight * sight.byObject.transpose() * sight.byObject;
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
    addStep<D>(linearised<D>(graph.steps[k], poses[k], poses[k + 1]), k, chain);
  for (const auto& sight : graph.sights)
    addSight<D>(
        linearised<D>(sight, poses[sight.pose], graph.objects[sight.object]), sight.pose,
        sight.object, huber, chain);
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
