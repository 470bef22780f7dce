#include <ceres/autodiff_cost_function.h>

#include <cmath>

#include "RowWriter.h"
#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/RobustKernel.h"
#include "quadmap/geometry/PoseAngles.h"
#include "quadmap/geometry/StepResidual.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/geometry/Whitening.h"
#include "quadmap/graph/GraphFactors.h"

namespace quadmap
{
namespace
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using QuaternionMap = Eigen::Map<const Eigen::Quaternion<T>>;

template <typename T>
using Parts = RotationAndTranslation<Eigen::Quaternion<T>, Vector3<T>>;

/** Rotation and translation of a PoseBlock. */
template <typename T>
Parts<T> partsOf(const T* block)
{
  return {Eigen::Quaternion<T>(block), Vector3<T>(block + 4)};
}

/** The step's residual (16.2), whitened: W^t W = covariance^-1. */
struct OdometryResidual
{
  Parts<double> measured;
  Matrix6 W;

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const
  {
    Eigen::Map<Eigen::Matrix<T, 6, 1>> r(residual);
    r = W.cast<T>() * stepResidual(partsOf(from), partsOf(to), measured);
    return true;
  }
};

OdometryResidual odometryResidual(const mrpt::poses::CPose3DPDFGaussian& step)
{
  // Angles (yaw, pitch, roll) -> turns about the axes of `to`.
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = localTurnsPerAngle(step.mean);
  const Matrix6 S = J * step.cov.asEigen() * J.transpose();
  return {partsOf(poseBlockOf(step.mean).data()), whiteningOf(S)};
}

/** The rows of the label alone, doc/mathematics.md, (11.17) and (11.18). */
class LabelPriorFactor : public ceres::CostFunction
{
 public:
  LabelPriorFactor(
      const LabelProperties& label, const EstimatorOptions& options, ObjectFreedom freedom) :
      label_(label), options_(options), freedom_(freedom)
  {
    set_num_residuals(kLabelPriorRows);
    *mutable_parameter_block_sizes() = {blockSize(freedom)};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override
  {
    RowWriter out(blocks[0], freedom_, residuals);
    if (jacobians) out.writeObjectJacobian(jacobians[0]);
    const int sizes = blockSize(freedom_) - 3;
    const Eigen::Vector3d logSizes = Eigen::Map<const Eigen::Vector3d>(blocks[0] + sizes);
    for (const ResidualRow& row : labelPriorRows(logSizes, label_, options_))
      out.add(row, 1.0, RobustKernel::quadratic().row(row.r, 1.0));
    return true;
  }

 private:
  LabelProperties label_;
  EstimatorOptions options_;
  ObjectFreedom freedom_;
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

/** How far the bottom of an object is above the floor, doc/mathematics.md, (16.8). */
template <ObjectFreedom kFreedom>
struct FloorResidual
{
  double sigma, huber;

  template <typename T>
  bool operator()(const T* object, const T* height, T* residual) const
  {
    const T bottom = object[2] - halfHeight<kFreedom>(object);
    residual[0] = RobustKernel::huber(huber).root(T((bottom - height[0]) / sigma));
    return true;
  }
};

/** r = S d + b with S^t S = L and S^t b = g, doc/mathematics.md, (16.9). */
template <int kSize>
struct ObjectPriorResidual
{
  ObjectBlock at;
  Eigen::Matrix<double, kSize, kSize> S;
  Eigen::Matrix<double, kSize, 1> b;
  double cauchy = 0;

  template <typename T>
  bool operator()(const T* object, T* residual) const
  {
    Eigen::Matrix<T, kSize, 1> d;
    for (int i = 0; i < 3; ++i) d[i] = object[i] - at[static_cast<std::size_t>(i)];
    if constexpr (kSize == 7)
      for (int i = 3; i < 7; ++i) d[i] = object[i] - at[static_cast<std::size_t>(i)];
    else
    {
      const Eigen::Quaterniond q_at(Eigen::Map<const Eigen::Quaterniond>(at.data() + 3));
      d.template segment<3>(3) =
          rotationVectorOf<T>(QuaternionMap<T>(object + 3) * q_at.conjugate().cast<T>());
      for (int i = 6; i < 9; ++i) d[i] = object[i + 1] - at[static_cast<std::size_t>(i + 1)];
    }
    Eigen::Map<Eigen::Matrix<T, kSize, 1>> r(residual);
    r = S.template cast<T>() * d + b.template cast<T>();
    if (cauchy > 0) soften<T>(r);
    return true;
  }

  /** Puts the whole residual under Cauchy's kernel, doc/mathematics.md, (19.8). */
  template <typename T>
  void soften(Eigen::Map<Eigen::Matrix<T, kSize, 1>>& r) const
  {
    constexpr double kNone = 1e-12;  // [sigmas^2]: the kernel is 1 there, and its quotient 0 / 0
    if (r.squaredNorm() < kNone) return;
    const T size = r.norm();
    r *= RobustKernel::cauchy(cauchy).root(size) / size;
  }
};

template <int kSize>
ObjectPriorResidual<kSize> objectPriorResidual(const ObjectPrior& prior)
{
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix(prior.L));
  const double smallest = 1e-9 * std::max(eigen.eigenvalues().maxCoeff(), 1e-9);
  ObjectPriorResidual<kSize> r{
      prior.at, Matrix::Zero(), Eigen::Matrix<double, kSize, 1>::Zero(), prior.cauchy};
  for (int i = 0; i < kSize; ++i)
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
  return differentiated<6, 7, 7>(odometryResidual(step));
}

Factor createLabelPrior(
    const LabelProperties& label, const EstimatorOptions& options, ObjectFreedom freedom)
{
  return std::make_unique<LabelPriorFactor>(label, options, freedom);
}

Factor createFloorFactor(double sigma, double huber, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright)
    return differentiated<1, 7, 1>(FloorResidual<ObjectFreedom::Upright>{sigma, huber});
  return differentiated<1, 10, 1>(FloorResidual<ObjectFreedom::Free>{sigma, huber});
}

Factor createObjectPrior(const ObjectPrior& prior, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright) return differentiated<7, 7>(objectPriorResidual<7>(prior));
  return differentiated<9, 10>(objectPriorResidual<9>(prior));
}

}  // namespace quadmap
