#include "quadmap/graph/GraphState.h"

#include <ceres/manifold.h>
#include <ceres/product_manifold.h>
#include <mrpt/math/CQuaternion.h>

#include <cmath>

#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
namespace
{
using Matrix43 = Eigen::Matrix<double, 4, 3, Eigen::RowMajor>;
using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/** dq/dw of q' = exp(w) q at w = 0, entries (x, y, z, w). */
Matrix43 quaternionPerRotationIncrement(const Eigen::Quaterniond& q)
{
  Matrix43 P;
  P.topRows<3>() = 0.5 * (q.w() * Eigen::Matrix3d::Identity() - crossMatrix(q.vec()));
  P.row(3) = -0.5 * q.vec().transpose();
  return P;
}

/** Unit quaternions (x, y, z, w) with increments along the axes of the reference
 * frame. */
class RotationManifold : public ceres::Manifold
{
 public:
  int AmbientSize() const override { return 4; }
  int TangentSize() const override { return 3; }

  bool Plus(const double* x, const double* step, double* sum) const override
  {
    const Eigen::Map<const Eigen::Quaterniond> q(x);
    const Eigen::Quaterniond turned =
        rotationOf(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(step))) * q;
    Eigen::Map<Eigen::Vector4d>(sum, 4) = turned.normalized().coeffs();
    return true;
  }
  bool PlusJacobian(const double* x, double* jacobian) const override
  {
    Eigen::Map<Matrix43>(jacobian, 4, 3) =
        quaternionPerRotationIncrement(Eigen::Map<const Eigen::Quaterniond>(x));
    return true;
  }
  bool Minus(const double* y, const double* x, double* difference) const override
  {
    const Eigen::Map<const Eigen::Quaterniond> to(y), from(x);
    Eigen::Map<Eigen::Vector3d>(difference, 3) = rotationVectorOf(to * from.conjugate());
    return true;
  }
  bool MinusJacobian(const double* x, double* jacobian) const override
  {
    Eigen::Map<Matrix34>(jacobian, 3, 4) =
        rotationIncrementPerQuaternion(Eigen::Map<const Eigen::Quaterniond>(x));
    return true;
  }
};

Eigen::Quaterniond quaternionOf(const mrpt::poses::CPose3D& pose)
{
  const Eigen::Matrix3d R = pose.getRotationMatrix().asEigen();
  return Eigen::Quaterniond(R).normalized();
}

mrpt::poses::CPose3D poseFrom(const Eigen::Quaterniond& q, const Eigen::Vector3d& t)
{
  const Eigen::Matrix3d R = q.normalized().toRotationMatrix();
  return mrpt::poses::CPose3D(
      mrpt::math::CMatrixDouble33(R), mrpt::math::TPoint3D(t.x(), t.y(), t.z()));
}

}  // namespace

Eigen::Matrix<double, 3, 4> rotationIncrementPerQuaternion(const Eigen::Quaterniond& q)
{
  return 4.0 * quaternionPerRotationIncrement(q).transpose();  // P^t P = I / 4
}

PoseBlock poseBlockOf(const mrpt::poses::CPose3D& T_map_robot)
{
  const Eigen::Quaterniond q = quaternionOf(T_map_robot);
  return {q.x(), q.y(), q.z(), q.w(), T_map_robot.x(), T_map_robot.y(), T_map_robot.z()};
}

mrpt::poses::CPose3D poseOf(const PoseBlock& block)
{
  return poseFrom(
      Eigen::Quaterniond(Eigen::Map<const Eigen::Quaterniond>(block.data())),
      Eigen::Map<const Eigen::Vector3d>(block.data() + 4));
}

ObjectBlock objectBlockOf(const Ellipsoid& object, ObjectFreedom freedom)
{
  ObjectBlock block{};
  if (freedom == ObjectFreedom::Upright)
  {
    Eigen::Map<UprightState>(block.data()) = uprightStateOf(object);
    return block;
  }
  Eigen::Map<Eigen::Vector3d>(block.data()) = object.center();
  Eigen::Map<Eigen::Vector4d>(block.data() + 3) = quaternionOf(object.pose()).coeffs();
  Eigen::Map<Eigen::Vector3d>(block.data() + 7) = object.semiAxes().array().log();
  return block;
}

Ellipsoid objectOf(const ObjectBlock& block, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright)
    return ellipsoidOf(Eigen::Map<const UprightState>(block.data()));
  const Eigen::Vector3d logSizes = Eigen::Map<const Eigen::Vector3d>(block.data() + 7);
  return Ellipsoid(
      poseFrom(
          Eigen::Quaterniond(Eigen::Map<const Eigen::Quaterniond>(block.data() + 3)),
          Eigen::Map<const Eigen::Vector3d>(block.data())),
      logSizes.array().exp());
}

ObjectShape shapeOf(const double* block, ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright)
    return ObjectShape(UprightState(Eigen::Map<const UprightState>(block)));
  const Eigen::Quaterniond q(Eigen::Map<const Eigen::Quaterniond>(block + 3));
  return {
      Eigen::Map<const Eigen::Vector3d>(block), q.normalized().toRotationMatrix(),
      Eigen::Map<const Eigen::Vector3d>(block + 7).array().exp()};
}

std::unique_ptr<ceres::Manifold> poseManifold()
{
  return std::make_unique<ceres::ProductManifold<RotationManifold, ceres::EuclideanManifold<3>>>();
}

std::unique_ptr<ceres::Manifold> objectManifold(ObjectFreedom freedom)
{
  if (freedom == ObjectFreedom::Upright) return nullptr;
  using Space = ceres::ProductManifold<
      ceres::EuclideanManifold<3>, RotationManifold, ceres::EuclideanManifold<3>>;
  return std::make_unique<Space>();
}

}  // namespace quadmap
