#include "PointFactors.h"

#include <ceres/autodiff_cost_function.h>

#include <stdexcept>
#include <type_traits>

#include "quadmap/geometry/StepResidual.h"
#include "quadmap/graph/GraphState.h"

namespace quadmap
{
namespace
{
template <typename T, int N>
using Vector = Eigen::Matrix<T, N, 1>;

template <typename T, int D>
using Parts = RotationAndTranslation<
    std::conditional_t<D == 2, Eigen::Rotation2D<T>, Eigen::Quaternion<T>>,
    Vector<T, D>>;

/** Rotation and translation of a block. */
template <int D, typename T>
Parts<T, D> partsOf(const T* block)
{
  if constexpr (D == 2)
    return {Eigen::Rotation2D<T>(block[2]), Vector<T, 2>(block)};
  else
    return {Eigen::Quaternion<T>(block), Vector<T, 3>(block + 4)};
}

/** The matrix W with W^t W = covariance^-1. */
template <int N>
Eigen::Matrix<double, N, N> whitening(const Eigen::Matrix<double, N, N>& covariance)
{
  const Eigen::LLT<Eigen::Matrix<double, N, N>> llt(covariance);
  if (llt.info() != Eigen::Success)
    throw std::invalid_argument("a covariance of the points is not positive definite");
  return llt.matrixL().solve(Eigen::Matrix<double, N, N>::Identity());
}

template <int D>
struct SightResidual
{
  PointVector<D> z;
  PointMatrix<D> W;

  template <typename T>
  bool operator()(const T* pose, const T* object, T* residual) const
  {
    const Parts<T, D> at = partsOf<D>(pose);
    const Vector<T, D> l = Eigen::Map<const Vector<T, D>>(object);
    const Vector<T, D> seen = at.R.inverse() * Vector<T, D>(l - at.t);
    Eigen::Map<Vector<T, D>>(residual, D) = W.template cast<T>() * (seen - z.template cast<T>());
    return true;
  }
};

template <int D>
struct OdometryResidual
{
  Parts<double, D> measured;
  PoseIncrementMatrix<D> W;

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const
  {
    Eigen::Map<Vector<T, kPoseIncrement<D>>>(residual, kPoseIncrement<D>) =
        W.template cast<T>() * stepResidual(partsOf<D>(from), partsOf<D>(to), measured);
    return true;
  }
};

constexpr int kBlock2 = 3, kBlock3 = 7;

}  // namespace

template <>
PointPoseBlock<2> pointBlockOf<2>(const PointPose<2>& pose)
{
  return {pose.t.x(), pose.t.y(), turnOf<2>(pose.R)[0]};
}

template <>
PointPoseBlock<3> pointBlockOf<3>(const PointPose<3>& pose)
{
  const Eigen::Quaterniond q(pose.R);
  return {q.x(), q.y(), q.z(), q.w(), pose.t.x(), pose.t.y(), pose.t.z()};
}

template <int D>
PointPose<D> pointPoseOf(const PointPoseBlock<D>& block)
{
  const Parts<double, D> parts = partsOf<D>(block.data());
  return {parts.R.toRotationMatrix(), parts.t};
}

template <>
std::unique_ptr<ceres::Manifold> pointPoseManifold<2>()
{
  return nullptr;
}

template <>
std::unique_ptr<ceres::Manifold> pointPoseManifold<3>()
{
  return poseManifold();
}

template <int D>
std::unique_ptr<ceres::CostFunction> createSightFactor(const typename PointGraph<D>::Sight& sight)
{
  constexpr int kBlock = D == 2 ? kBlock2 : kBlock3;
  return std::make_unique<ceres::AutoDiffCostFunction<SightResidual<D>, D, kBlock, D>>(
      new SightResidual<D>{sight.position, whitening<D>(sight.covariance)});
}

template <int D>
std::unique_ptr<ceres::CostFunction> createPointStepFactor(const PointOdometry<D>& step)
{
  constexpr int kBlock = D == 2 ? kBlock2 : kBlock3;
  using Residual = OdometryResidual<D>;
  return std::make_unique<ceres::AutoDiffCostFunction<Residual, kPoseIncrement<D>, kBlock, kBlock>>(
      new Residual{
          partsOf<D>(pointBlockOf<D>(step.T_from_to).data()),
          whitening<kPoseIncrement<D>>(step.covariance)});
}

template PointPose<2> pointPoseOf<2>(const PointPoseBlock<2>&);
template PointPose<3> pointPoseOf<3>(const PointPoseBlock<3>&);
template std::unique_ptr<ceres::CostFunction> createSightFactor<2>(const PointGraph<2>::Sight&);
template std::unique_ptr<ceres::CostFunction> createSightFactor<3>(const PointGraph<3>::Sight&);
template std::unique_ptr<ceres::CostFunction> createPointStepFactor<2>(const PointOdometry<2>&);
template std::unique_ptr<ceres::CostFunction> createPointStepFactor<3>(const PointOdometry<3>&);

}  // namespace quadmap
