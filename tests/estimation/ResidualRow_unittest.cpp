#include "quadmap/estimation/ResidualRow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../geometry/RandomGeometry.h"
#include "quadmap/geometry/Support.h"

using namespace quadmap;
using namespace quadmap::test;

TEST(TangencyResidual, IsZeroOnTangentPlanesAndTheGapInMetresElsewhere)
{
  RandomGeometry random(35);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Ellipsoid object = random.ellipsoid(random.vector(-3, 3));
    const Eigen::Vector3d unit = random.direction();
    const Eigen::Vector3d outward =
        (object.rotation() * unit.cwiseQuotient(object.semiAxes())).normalized();
    const Plane tangent = Plane::throughPoint(-outward, surfacePoint(object, unit));
    EXPECT_NEAR(tangencyResidual(tangent, object), 0, 1e-13);
    const Plane away{tangent.n, tangent.d + 0.2}, cutting{tangent.n, tangent.d - 0.05};
    EXPECT_NEAR(tangencyResidual(away, object), 0.2, 1e-13);
    EXPECT_NEAR(tangencyResidual(cutting, object), -0.05, 1e-13);
  }
}

TEST(TangencyResidual, WithExponentOneIsTheDistanceToTheNearestCorner)
{
  RandomGeometry random(36);
  const Ellipsoid object = random.ellipsoid({1, 2, 3});
  const Plane plane = Plane::throughPoint(random.direction(), {-2, 0, 1});
  double nearest = 100;
  for (int i = 0; i < 8; ++i)
    nearest = std::min(nearest, plane.signedDistance(object.cuboidCorners().col(i)));
  EXPECT_NEAR(
      tangencyResidual(plane, object, 1), nearest,
      3 * kSupportSmoothing * object.semiAxes().norm());
}

TEST(FaceRow, IsTheGapBetweenTheObjectAndTheFacesPlane)
{
  RandomGeometry random(37);
  const Ellipsoid object = random.ellipsoid({1, 2, 3});
  const ObjectShape shape(object.center(), object.rotation(), object.semiAxes());
  const Eigen::Vector3d measured(1.1, 1.9, 3.2), outward = random.direction();
  const Plane inwards = Plane::throughPoint(-outward, measured + 0.4 * outward);
  EXPECT_NEAR(
      faceRow(-outward, shape.t - measured, 0.4, shape, 1.5).r,
      tangencyResidual(inwards, object, 1.5), 1e-13);
}
