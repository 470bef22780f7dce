#include "quadmap/geometry/Ellipsoid.h"

#include <gtest/gtest.h>

#include "NotFinite.h"
#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

TEST(Ellipsoid, IsAUnitSphereByDefault)
{
  const Ellipsoid sphere;
  EXPECT_EQ(sphere.semiAxes(), Eigen::Vector3d::Ones());
  EXPECT_EQ(sphere.center(), Eigen::Vector3d::Zero());
  EXPECT_EQ(sphere.rotation(), Eigen::Matrix3d::Identity());
}

TEST(Ellipsoid, RejectsSizesThatAreNotPositiveAndFinite)
{
  for (double bad : {0.0, -0.1, kNaN, kInf})
    for (int axis = 0; axis < 3; ++axis)
    {
      Eigen::Vector3d s(0.1, 0.2, 0.3);
      s[axis] = bad;
      EXPECT_THROW(Ellipsoid(mrpt::poses::CPose3D(), s), std::invalid_argument) << s.transpose();
    }
}

TEST(Ellipsoid, RejectsAPoseThatIsNotFinite)
{
  for (double bad : {kNaN, kInf})
  {
    const Eigen::Vector3d s(0.1, 0.2, 0.3);
    EXPECT_THROW(Ellipsoid(mrpt::poses::CPose3D(0, bad, 0, 0, 0, 0), s), std::invalid_argument);
    EXPECT_THROW(Ellipsoid(mrpt::poses::CPose3D(0, 0, 0, bad, 0, 0), s), std::invalid_argument);
  }
}

TEST(Ellipsoid, CornersHaveTheSignsOfTheirBits)
{
  const Ellipsoid object(mrpt::poses::CPose3D(1, 2, 3, 0, 0, 0), {0.1, 0.2, 0.3});
  const auto corners = object.cuboidCorners();
  EXPECT_TRUE(corners.col(0).isApprox(Eigen::Vector3d(0.9, 1.8, 2.7)));
  EXPECT_TRUE(corners.col(1).isApprox(Eigen::Vector3d(1.1, 1.8, 2.7)));
  EXPECT_TRUE(corners.col(2).isApprox(Eigen::Vector3d(0.9, 2.2, 2.7)));
  EXPECT_TRUE(corners.col(4).isApprox(Eigen::Vector3d(0.9, 1.8, 3.3)));
  EXPECT_TRUE(corners.col(7).isApprox(Eigen::Vector3d(1.1, 2.2, 3.3)));
  EXPECT_DOUBLE_EQ(object.cuboidVolume(), 0.2 * 0.4 * 0.6);
}

TEST(Ellipsoid, RotatedCornersAreTheCentrePlusTheAxes)
{
  RandomGeometry random(1);
  const Ellipsoid object = random.ellipsoid({1, -2, 3});
  const Eigen::Matrix3d R = object.rotation();
  const Eigen::Vector3d s = object.semiAxes();
  const Eigen::Vector3d corner5 =
      object.center() + s.x() * R.col(0) - s.y() * R.col(1) + s.z() * R.col(2);
  EXPECT_LT((object.cuboidCorners().col(5) - corner5).norm(), 1e-14);
}

TEST(Ellipsoid, DualQuadricVanishesOnTangentPlanesOfSurfacePoints)
{
  RandomGeometry random(2);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Ellipsoid object = random.ellipsoid(random.vector(-3, 3));
    // The gradient of (x/a)^2 + (y/b)^2 + (z/c)^2 at a surface point is the tangent plane's normal.
    const Eigen::Vector3d unit = random.direction();
    const Eigen::Vector3d normal =
        (object.rotation() * unit.cwiseQuotient(object.semiAxes())).normalized();
    const Eigen::Vector3d point = surfacePoint(object, unit);
    const Eigen::Vector4d plane(normal.x(), normal.y(), normal.z(), -normal.dot(point));
    const Eigen::Matrix4d Q = object.dualQuadric();
    EXPECT_NEAR(plane.dot(Q * plane), 0, 1e-13);
    EXPECT_LT((Q - Q.transpose()).norm(), 1e-15 * Q.norm());
    const Eigen::Vector4d farther = plane + Eigen::Vector4d(0, 0, 0, 0.1);
    EXPECT_GT(std::abs(farther.dot(Q * farther)), 1e-3);
  }
}

TEST(Ellipsoid, TransformedMovesEveryPointOfTheSurface)
{
  RandomGeometry random(3);
  const Ellipsoid object = random.ellipsoid({1, 2, 3});
  const mrpt::poses::CPose3D T_new_ref = random.pose(5);
  const Ellipsoid moved = object.transformed(T_new_ref);
  for (int i = 0; i < 20; ++i)
  {
    const Eigen::Vector3d unit = random.direction();
    const Eigen::Vector3d p = surfacePoint(object, unit), q = surfacePoint(moved, unit);
    const auto expected = T_new_ref.composePoint(mrpt::math::TPoint3D(p.x(), p.y(), p.z()));
    EXPECT_LT((q - Eigen::Vector3d(expected.x, expected.y, expected.z)).norm(), 1e-13);
  }
}
