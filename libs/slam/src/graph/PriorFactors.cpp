#include <ceres/autodiff_cost_function.h>
#include <ceres/rotation.h>

#include <cmath>
#include <stdexcept>

#include "../PoseAngles.h"
#include "RobustRow.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/slam/graph/GraphFactors.h"

namespace quadmap
{
namespace
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using QuaternionMap = Eigen::Map<const Eigen::Quaternion<T>>;

/** Rotation vector of a unit quaternion. */
template <typename T>
Vector3<T> rotationVector(const Eigen::Quaternion<T>& q)
{
  const T wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
  Vector3<T> v;
  ceres::QuaternionToAngleAxis(wxyz, v.data());
  return v;
}

/** r = W [R_f^t (t_t - t_f) - t_m; log(R_m^t R_f^t R_t)]: the position's error along the axes of
 * `from`, the rotation's along those of `to`; W^t W = covariance^-1. */
struct StepResidual
{
  Eigen::Quaterniond q_m;
  Eigen::Vector3d t_m;
  Matrix6 W;

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const
  {
    const QuaternionMap<T> q_f(from), q_t(to);
    const Eigen::Map<const Vector3<T>> t_f(from + 4), t_t(to + 4);
    Eigen::Matrix<T, 6, 1> e;
    e.template head<3>() = q_f.conjugate() * Vector3<T>(t_t - t_f) - t_m.cast<T>();
    e.template tail<3>() = rotationVector<T>(q_m.cast<T>().conjugate() * (q_f.conjugate() * q_t));
    Eigen::Map<Eigen::Matrix<T, 6, 1>> r(residual);
    r = W.cast<T>() * e;
    return true;
  }
};

StepResidual stepResidual(const mrpt::poses::CPose3DPDFGaussian& step)
{
  // Angles (yaw, pitch, roll) -> turns about the axes of `to`.
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = localTurnsPerAngle(step.mean);
  const Matrix6 S = J * step.cov.asEigen() * J.transpose();
  const Eigen::LLT<Matrix6> llt(S);
  if (llt.info() != Eigen::Success || !S.allFinite())
    throw std::invalid_argument("createOdometryFactor: the covariance is not positive definite");
  const PoseBlock mean = poseBlockOf(step.mean);
  const Eigen::Map<const Eigen::Quaterniond> q(mean.data());
  const Eigen::Map<const Eigen::Vector3d> t(mean.data() + 4);
  return {q, t, llt.matrixL().solve(Matrix6(Matrix6::Identity()))};
}

struct PosePriorResidual
{
  StepResidual step;

  template <typename T>
  bool operator()(const T* pose, T* residual) const
  {
    const T map[7] = {T(0), T(0), T(0), T(1), T(0), T(0), T(0)};
    return step(map, pose, residual);
  }
};

/** r = (ln s - expected) / spread, and (ln a - ln b) / sigma for round things. */
struct LabelResidual
{
  LabelProperties label;
  double spread, roundnessSigma;
  int sizes;  // index of ln a in the block

  template <typename T>
  bool operator()(const T* object, T* residual) const
  {
    const T* x = object + sizes;
    const Eigen::Vector3d typical = (0.5 * label.typicalSize).array().log();
    const bool swap = (x[0] - x[1]) * (typical[0] - typical[1]) < 0.0;  // x and y are unordered
    residual[0] = (x[0] - typical[swap ? 1 : 0]) / spread;
    residual[1] = (x[1] - typical[swap ? 0 : 1]) / spread;
    residual[2] = (x[2] - typical[2]) / spread;
    residual[3] = label.dominantDirection ? T(0) : T((x[0] - x[1]) / roundnessSigma);
    return true;
  }
};

/** How far the object reaches down from its centre: its half height when upright, else that of its
 * ellipsoid. */
template <ObjectFreedom kFreedom, typename T>
T halfHeight(const T* object)
{
  using std::exp;
  if constexpr (kFreedom == ObjectFreedom::Upright)
    return exp(object[6]);
  else
  {
    const QuaternionMap<T> q(object + 3);
    const Vector3<T> down = q.conjugate() * Vector3<T>(T(0), T(0), T(1));
    const Vector3<T> s(exp(object[7]), exp(object[8]), exp(object[9]));
    return supportFunction<T>(down, s, 2.0);
  }
}

/** Huber's kernel for automatic derivatives. */
template <typename T>
T robust(const T& r, double huber)
{
  using std::sqrt;
  if (r > huber) return sqrt(huber * (2.0 * r - huber));
  if (r < -huber) return -sqrt(huber * (-2.0 * r - huber));
  return r;
}

template <ObjectFreedom kFreedom>
struct FloorResidual
{
  double sigma, huber;

  template <typename T>
  bool operator()(const T* object, const T* height, T* residual) const
  {
    const T bottom = object[2] - halfHeight<kFreedom>(object);
    residual[0] = robust<T>((bottom - height[0]) / sigma, huber);
    return true;
  }
};

struct StandsOnResidual
{
  double sigma, huber;

  template <typename T>
  bool operator()(const T* upper, const T* lower, T* residual) const
  {
    const T bottom = upper[2] - halfHeight<ObjectFreedom::Upright>(upper);
    const T top = lower[2] + halfHeight<ObjectFreedom::Upright>(lower);
    residual[0] = robust<T>((bottom - top) / sigma, huber);
    return true;
  }
};

/** r = S d + b with S^t S = L, S^t b = g. */
template <int kStep>
struct ObjectPriorResidual
{
  ObjectBlock at;
  Eigen::Matrix<double, kStep, kStep> S;
  Eigen::Matrix<double, kStep, 1> b;
  double cauchy = 0;

  template <typename T>
  bool operator()(const T* object, T* residual) const
  {
    Eigen::Matrix<T, kStep, 1> d;
    for (int i = 0; i < 3; ++i) d[i] = object[i] - at[static_cast<std::size_t>(i)];
    if constexpr (kStep == 7)
      for (int i = 3; i < 7; ++i) d[i] = object[i] - at[static_cast<std::size_t>(i)];
    else
    {
      const Eigen::Quaterniond q_at(Eigen::Map<const Eigen::Quaterniond>(at.data() + 3));
      d.template segment<3>(3) =
          rotationVector<T>(QuaternionMap<T>(object + 3) * q_at.conjugate().cast<T>());
      for (int i = 6; i < 9; ++i) d[i] = object[i + 1] - at[static_cast<std::size_t>(i + 1)];
    }
    Eigen::Map<Eigen::Matrix<T, kStep, 1>> r(residual);
    r = S.template cast<T>() * d + b.template cast<T>();
    if (cauchy > 0) soften<T>(r);
    return true;
  }

  template <typename T>
  void soften(Eigen::Map<Eigen::Matrix<T, kStep, 1>>& r) const
  {
    using std::log;
    using std::sqrt;
    constexpr double kNone = 1e-12;  // [sigmas^2]: the kernel is 1 there, and its quotient 0 / 0
    const double squaredCauchy = cauchy * cauchy;
    const T square = r.squaredNorm();
    if (square < kNone) return;
    r *= sqrt(squaredCauchy * log(1.0 + square / squaredCauchy) / square);
  }
};

template <int kStep>
ObjectPriorResidual<kStep> objectPriorResidual(const ObjectPrior& prior)
{
  using Matrix = Eigen::Matrix<double, kStep, kStep>;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix(prior.L));
  const double smallest = 1e-9 * std::max(eigen.eigenvalues().maxCoeff(), 1e-9);
  ObjectPriorResidual<kStep> r{
      prior.at, Matrix::Zero(), Eigen::Matrix<double, kStep, 1>::Zero(), prior.cauchy};
  for (int i = 0; i < kStep; ++i)
  {
    const double value = eigen.eigenvalues()[i];
    if (value <= smallest) continue;  // nothing is known in this direction
    r.S.row(i) = std::sqrt(value) * eigen.eigenvectors().col(i).transpose();
    r.b[i] = eigen.eigenvectors().col(i).dot(prior.g) / std::sqrt(value);
  }
  return r;
}

/** Moves a functor into the cost function that Ceres wants. */
template <int kResiduals, int... kBlocks, typename Functor>
Factor differentiated(Functor functor)
{
  return std::make_unique<ceres::AutoDiffCostFunction<Functor, kResiduals, kBlocks...>>(
      new Functor(std::move(functor)));
}

}  // namespace

Factor createOdometryFactor(const mrpt::poses::CPose3DPDFGaussian& step)
{
  return differentiated<6, 7, 7>(stepResidual(step));
}

Factor createPosePrior(const mrpt::poses::CPose3DPDFGaussian& T_map_robot)
{
  return differentiated<6, 7>(PosePriorResidual{stepResidual(T_map_robot)});
}

Factor createLabelPrior(
    const LabelProperties& label, const EstimatorOptions& options, ObjectFreedom freedom)
{
  const double spread = label.sizeSpread * options.sizePriorSpread;
  if (freedom == ObjectFreedom::Upright)
    return differentiated<4, 7>(LabelResidual{label, spread, options.roundnessSigma, 4});
  return differentiated<4, 10>(LabelResidual{label, spread, options.roundnessSigma, 7});
}

Factor createFloorFactor(double sigma, double huber, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright)
    return differentiated<1, 7, 1>(FloorResidual<ObjectFreedom::Upright>{sigma, huber});
  return differentiated<1, 10, 1>(FloorResidual<ObjectFreedom::Free>{sigma, huber});
}

Factor createStandsOnFactor(double sigma, double huber)
{
  return differentiated<1, 7, 7>(StandsOnResidual{sigma, huber});
}

Factor createObjectPrior(const ObjectPrior& prior, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright) return differentiated<7, 7>(objectPriorResidual<7>(prior));
  return differentiated<9, 10>(objectPriorResidual<9>(prior));
}

}  // namespace quadmap
