#include "PointFactors.h"

#include <ceres/autodiff_cost_function.h>

#include <type_traits>

#include "quadmap/geometry/StepResidual.h"
#include "quadmap/geometry/Whitening.h"
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

template <int D>
constexpr int kBlock = D == 2 ? 3 : 7;

/** As Ceres writes derivatives. */
template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;

/** Derivatives by the increments (shift, turn) of a pose, from those by its block. */
template <int D, int Rows>
Eigen::Matrix<double, Rows, kPoseIncrement<D>> byIncrements(
    const RowMajor<Rows, kBlock<D>>& byBlock, const PointPoseBlock<D>& pose)
{
  if constexpr (D == 2)
    return byBlock;
  else
  {
    RowMajor<7, 6> plus;
    poseManifold()->PlusJacobian(pose.data(), plus.data());
    const RowMajor<Rows, 6> byTurnAndShift = byBlock * plus;
    Eigen::Matrix<double, Rows, 6> ordered;
    ordered << byTurnAndShift.template rightCols<3>(), byTurnAndShift.template leftCols<3>();
    return ordered;
  }
}

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
  return std::make_unique<ceres::AutoDiffCostFunction<SightResidual<D>, D, kBlock<D>, D>>(
      new SightResidual<D>{sight.position, whiteningOf<D>(sight.covariance)});
}

template <int D>
std::unique_ptr<ceres::CostFunction> createPointStepFactor(const PointOdometry<D>& step)
{
  using Residual = OdometryResidual<D>;
  using Factor = ceres::AutoDiffCostFunction<Residual, kPoseIncrement<D>, kBlock<D>, kBlock<D>>;
  return std::make_unique<Factor>(new Residual{
      partsOf<D>(pointBlockOf<D>(step.T_from_to).data()),
      whiteningOf<kPoseIncrement<D>>(step.covariance)});
}

template <int D>
LinearisedSight<D> linearised(
    const typename PointGraph<D>::Sight& sight,
    const PointPose<D>& pose,
    const PointVector<D>& object)
{
  const PointPoseBlock<D> block = pointBlockOf<D>(pose);
  RowMajor<D, kBlock<D>> byBlock;
  RowMajor<D, D> byObject;
  const std::array<const double*, 2> at = {block.data(), object.data()};
  std::array<double*, 2> derivatives = {byBlock.data(), byObject.data()};
  LinearisedSight<D> out;
  createSightFactor<D>(sight)->Evaluate(at.data(), out.r.data(), derivatives.data());
  out.byPose = byIncrements<D, D>(byBlock, block);
  out.byObject = byObject;
  return out;
}

template <int D>
LinearisedStep<D> linearised(
    const PointOdometry<D>& step, const PointPose<D>& from, const PointPose<D>& to)
{
  constexpr int kRows = kPoseIncrement<D>;
  const PointPoseBlock<D> start = pointBlockOf<D>(from), end = pointBlockOf<D>(to);
  RowMajor<kRows, kBlock<D>> byStart, byEnd;
  const std::array<const double*, 2> at = {start.data(), end.data()};
  std::array<double*, 2> derivatives = {byStart.data(), byEnd.data()};
  Vector<double, kRows> r;
  createPointStepFactor<D>(step)->Evaluate(at.data(), r.data(), derivatives.data());
  return {byIncrements<D, kRows>(byStart, start), byIncrements<D, kRows>(byEnd, end)};
}

template PointPose<2> pointPoseOf<2>(const PointPoseBlock<2>&);
template PointPose<3> pointPoseOf<3>(const PointPoseBlock<3>&);
template std::unique_ptr<ceres::CostFunction> createSightFactor<2>(const PointGraph<2>::Sight&);
template std::unique_ptr<ceres::CostFunction> createSightFactor<3>(const PointGraph<3>::Sight&);
template std::unique_ptr<ceres::CostFunction> createPointStepFactor<2>(const PointOdometry<2>&);
template std::unique_ptr<ceres::CostFunction> createPointStepFactor<3>(const PointOdometry<3>&);
template LinearisedSight<2> linearised<2>(
    const PointGraph<2>::Sight&, const PointPose<2>&, const PointVector<2>&);
template LinearisedSight<3> linearised<3>(
    const PointGraph<3>::Sight&, const PointPose<3>&, const PointVector<3>&);
template LinearisedStep<2> linearised<2>(
    const PointOdometry<2>&, const PointPose<2>&, const PointPose<2>&);
template LinearisedStep<3> linearised<3>(
    const PointOdometry<3>&, const PointPose<3>&, const PointPose<3>&);

}  // namespace quadmap
