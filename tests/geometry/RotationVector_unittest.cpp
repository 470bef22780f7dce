#include "quadmap/geometry/RotationVector.h"

#include <gtest/gtest.h>

using namespace quadmap;

namespace
{
const Eigen::Vector3d kVectors[] = {
    {          0,     0,     0},
    {      1e-10,     0, -2e-9},
    {       3e-4, -5e-4,  1e-4},
    {        0.3,  -0.8,   0.4},
    {        2.0,   1.5,  -1.0},
    {M_PI - 1e-3,     0,     0},
};

}  // namespace

TEST(RotationVector, TurnsAboutItsAxis)
{
  for (const auto& v : kVectors)
  {
    const double angle = v.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(v / angle) : Eigen::Vector3d::UnitX();
    const Eigen::Matrix3d R = rotationOf(v).toRotationMatrix();
    EXPECT_LT((R - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 1e-12);
  }
}

TEST(RotationVector, RoundTripsAlsoForTheOtherSignOfTheQuaternion)
{
  for (const auto& v : kVectors)
  {
    Eigen::Quaterniond q = rotationOf(v);
    EXPECT_LT((rotationVectorOf(q) - v).norm(), 1e-12);
    q.coeffs() *= -1;
    EXPECT_LT((rotationVectorOf(q) - v).norm(), 1e-12);
  }
}

TEST(RotationVector, TurnsDirectionsToZTheShortestWay)
{
  for (const auto& v : kVectors)
  {
    if (v.norm() == 0) continue;
    const Eigen::Vector3d direction = v.normalized();
    const Eigen::Quaterniond turn = turnToZ(v);
    EXPECT_LT((turn * direction - Eigen::Vector3d::UnitZ()).norm(), 1e-12) << v.transpose();
    EXPECT_NEAR(rotationVectorOf(turn).norm(), std::acos(direction.z()), 1e-7) << v.transpose();
  }
}

TEST(RotationVector, CrossMatrixIsTheCrossProduct)
{
  const Eigen::Vector3d v(1, -2, 3), w(0.5, 4, -1);
  EXPECT_LT((crossMatrix(v) * w - v.cross(w)).norm(), 1e-15);
}

TEST(RotationVector, InverseLeftJacobianIsTheDerivativeOfTheLogarithm)
{
  for (const auto& v : kVectors)
    for (int i = 0; i < 3; ++i)
    {
      const double h = 1e-5;
      const Eigen::Vector3d plus = h * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d numeric = (rotationVectorOf(rotationOf(plus) * rotationOf(v)) -
                                       rotationVectorOf(rotationOf(-plus) * rotationOf(v))) /
                                      (2 * h);
      EXPECT_LT((inverseLeftJacobian(v).col(i) - numeric).norm(), 1e-6) << v.transpose();
    }
}
