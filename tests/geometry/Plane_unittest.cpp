#include "quadmap/geometry/Plane.h"

#include <gtest/gtest.h>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

TEST(Plane, ThroughAPointHasNoDistanceThere)
{
  RandomGeometry random(11);
  const Eigen::Vector3d n = random.direction(), p = random.vector(-3, 3);
  const Plane plane = Plane::throughPoint(n, p);
  EXPECT_NEAR(plane.signedDistance(p), 0, 1e-14);
  EXPECT_NEAR(plane.signedDistance(p + 0.3 * n), 0.3, 1e-14);
  EXPECT_NEAR(plane.signedDistance(p - 0.2 * n), -0.2, 1e-14);
}

TEST(Plane, DistancesDoNotDependOnTheFrame)
{
  RandomGeometry random(12);
  for (int i = 0; i < 50; ++i)
  {
    const Plane plane_b = Plane::throughPoint(random.direction(), random.vector(-3, 3));
    const mrpt::poses::CPose3D T_a_b = random.pose(4);
    const Eigen::Vector3d p_b = random.vector(-5, 5);
    const auto p_a = T_a_b.composePoint(mrpt::math::TPoint3D(p_b.x(), p_b.y(), p_b.z()));
    const Plane plane_a = plane_b.transformed(T_a_b);
    EXPECT_NEAR(plane_a.n.norm(), 1, 1e-14);
    EXPECT_NEAR(plane_a.signedDistance({p_a.x, p_a.y, p_a.z}), plane_b.signedDistance(p_b), 1e-13);
  }
}
