#include "quadmap/geometry/Projection.h"

#include <gtest/gtest.h>

#include <limits>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

namespace
{
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** Bounds of many projected points of the surface. Of n random directions the nearest one to a true
 * extreme is within sqrt(10/n) rad of it. The boxes are therefore too small by up to 5/n of their
 * size. */
struct SampledBox
{
  ImageBox box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  void add(const PinholeCamera& camera, const Eigen::Vector3d& p)
  {
    const double u = camera.fx * p.x() / p.z() + camera.cx;
    const double v = camera.fy * p.y() / p.z() + camera.cy;
    box = {std::min(box.x1, u), std::min(box.y1, v), std::max(box.x2, u), std::max(box.y2, v)};
  }
};

ImageBox sampledEllipsoidBox(
    const PinholeCamera& camera, const Ellipsoid& object, RandomGeometry& random)
{
  SampledBox sampled;
  for (int i = 0; i < 20000; ++i) sampled.add(camera, surfacePoint(object, random.direction()));
  return sampled.box;
}

/** Bounds of a dense grid on the six faces of the cuboid, without points nearer than `nearPlane`.
 */
ImageBox sampledCuboidBox(const PinholeCamera& camera, const Ellipsoid& object, double nearPlane)
{
  constexpr int kSteps = 200;
  SampledBox sampled;
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1.0, 1.0})
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j)
        {
          Eigen::Vector3d p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / kSteps - 1;
          p[(axis + 2) % 3] = 2.0 * j / kSteps - 1;
          p = object.rotation() * p.cwiseProduct(object.semiAxes()) + object.center();
          if (p.z() >= nearPlane) sampled.add(camera, p);
        }
  return sampled.box;
}

void expectNear(const ImageBox& a, const ImageBox& b, double tolerance)
{
  EXPECT_NEAR(a.x1, b.x1, tolerance);
  EXPECT_NEAR(a.y1, b.y1, tolerance);
  EXPECT_NEAR(a.x2, b.x2, tolerance);
  EXPECT_NEAR(a.y2, b.y2, tolerance);
}

/** Random objects entirely in front of a camera. */
Ellipsoid objectAhead(RandomGeometry& random)
{
  const double z = random.uniform(1.5, 6);
  return random.ellipsoid({random.uniform(-0.6, 0.6) * z, random.uniform(-0.5, 0.5) * z, z});
}
}  // namespace

TEST(ProjectEllipsoidBox, EnclosesTheSampledSurfaceTightly)
{
  RandomGeometry random(41);
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (int trial = 0; trial < 25; ++trial)
    {
      const Ellipsoid object = objectAhead(random);
      const auto box = projectEllipsoidBox(camera, object);
      ASSERT_TRUE(box);
      const ImageBox oracle = sampledEllipsoidBox(camera, object, random);
      expectNear(*box, oracle, 1.0);  // 5/20000 of up to 800 px, times up to 4 for perspective
      EXPECT_LE(box->x1, oracle.x1 + 1e-9);
      EXPECT_LE(box->y1, oracle.y1 + 1e-9);
      EXPECT_GE(box->x2, oracle.x2 - 1e-9);
      EXPECT_GE(box->y2, oracle.y2 - 1e-9);
    }
}

TEST(ProjectEllipsoidBox, OfASphereAheadIsTheAngleOfItsTangents)
{
  // Radius 0.5 at 2 m: tangents at asin(0.5 / 2).
  const Ellipsoid sphere(mrpt::poses::CPose3D(0, 0, 2, 0, 0, 0), {0.5, 0.5, 0.5});
  const auto box = projectEllipsoidBox(kinectCamera(), sphere);
  ASSERT_TRUE(box);
  const double half = 525 * std::tan(std::asin(0.25));
  expectNear(*box, {319.5 - half, 239.5 - half, 319.5 + half, 239.5 + half}, 1e-9);
}

TEST(ProjectEllipsoidBox, StaysExactFarAway)
{
  const Ellipsoid cup(mrpt::poses::CPose3D(0, 0, 1000, 0, 0, 0), {0.05, 0.05, 0.05});
  const auto box = projectEllipsoidBox(kinectCamera(), cup);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->width(), 2 * 525 * std::tan(std::asin(0.05 / 1000)), 1e-9);
}

TEST(ProjectEllipsoidBox, DoesNotExistUnlessTheObjectIsEntirelyAhead)
{
  const Eigen::Vector3d s(0.5, 0.3, 0.4);
  const auto at = [&](double x, double y, double z)
  {
    return projectEllipsoidBox(
        kinectCamera(), Ellipsoid(mrpt::poses::CPose3D(x, y, z, 0, 0, 0), s));
  };
  EXPECT_FALSE(at(0, 0, -3)) << "behind";
  EXPECT_FALSE(at(0, 0, 0)) << "camera at the centre";
  EXPECT_FALSE(at(0.1, 0.1, 0.2)) << "camera inside";
  EXPECT_FALSE(at(2, 0, 0.3)) << "beside the camera, cut by its plane";
  EXPECT_FALSE(at(2, 0, 0.4)) << "touching the camera's plane";
  EXPECT_FALSE(at(0, 0, -0.4)) << "touching from behind";
  EXPECT_TRUE(at(2, 0, 0.41)) << "beside the camera, just ahead of its plane";
}

TEST(ProjectDualConic, TouchesTheTangentLinesOfTheOutline)
{
  RandomGeometry random(42);
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (int trial = 0; trial < 20; ++trial)
    {
      const Ellipsoid object = objectAhead(random);
      // The normal of a tangent plane through the camera centre: bisection on its angle around a
      // random axis.
      const Eigen::Vector3d side = random.direction().cross(object.center()).normalized();
      const Eigen::Vector3d ahead = object.center().normalized();
      double low = 0, high = M_PI / 2;
      const auto planeAt = [&](double angle) -> Eigen::Vector3d
      { return std::sin(angle) * ahead + std::cos(angle) * side; };
      for (int i = 0; i < 60; ++i)
      {
        const double middle = (low + high) / 2;
        const Eigen::Vector3d n = planeAt(middle);
        const bool isAside = n.dot(object.center()) > std::sqrt(n.dot(object.shapeMatrix() * n));
        (isAside ? high : low) = middle;
      }
      const Eigen::Vector3d line = camera.matrix().inverse().transpose() * planeAt(low);
      const Eigen::Matrix3d C = projectDualConic(camera, object);
      const double scale = (C * line).norm() * line.norm();
      EXPECT_NEAR(line.dot(C * line) / scale, 0, 1e-9);
    }
}

TEST(ProjectCuboidBox, EnclosesTheSampledSides)
{
  RandomGeometry random(43);
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (int trial = 0; trial < 10; ++trial)
    {
      const Ellipsoid object = objectAhead(random);
      const auto box = projectCuboidBox(camera, object);
      ASSERT_TRUE(box);
      expectNear(*box, sampledCuboidBox(camera, object, 0.05), 1e-6);  // the grid has the corners
    }
}

TEST(ProjectCuboidBox, CutByTheCameraPlaneKeepsThePartAhead)
{
  RandomGeometry random(44);
  int cut = 0;
  for (int trial = 0; trial < 30; ++trial)
  {
    const Ellipsoid object =
        random.ellipsoid({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.3, 0.8)});
    const double nearPlane = 0.2;
    const Eigen::Matrix<double, 1, 8> depth = object.cuboidCorners().row(2);
    if (depth.minCoeff() >= nearPlane || depth.maxCoeff() < nearPlane + 0.1) continue;
    ++cut;
    const auto box = projectCuboidBox(kinectCamera(), object, nearPlane);
    ASSERT_TRUE(box);
    const ImageBox oracle = sampledCuboidBox(kinectCamera(), object, nearPlane);
    // The grid's points end up to 1.2 m / 200 behind the near plane: 525 * 0.006 * x / 0.2^2.
    const double tolerance = 0.05 * std::max({oracle.width(), oracle.height(), 2000.0});
    expectNear(*box, oracle, tolerance);
    EXPECT_LE(box->x1, oracle.x1 + 1e-9);
    EXPECT_LE(box->y1, oracle.y1 + 1e-9);
    EXPECT_GE(box->x2, oracle.x2 - 1e-9);
    EXPECT_GE(box->y2, oracle.y2 - 1e-9);
  }
  EXPECT_GT(cut, 5);
}

TEST(ProjectCuboidBox, CutCuboidHasTheBoxOfItsNearPlaneSection)
{
  // [-1, 1] x [-1, 1] x [-1, 1] around the camera: the near plane's section is the widest.
  const auto box = projectCuboidBox(kinectCamera(), Ellipsoid(), 0.5);
  ASSERT_TRUE(box);
  expectNear(*box, {319.5 - 1050, 239.5 - 1050, 319.5 + 1050, 239.5 + 1050}, 1e-9);
}

TEST(ProjectCuboidBox, DoesNotExistBehindTheCamera)
{
  const Ellipsoid behind(mrpt::poses::CPose3D(0, 0, -2, 0.3, 0.2, 0.1), {0.5, 0.3, 0.4});
  EXPECT_FALSE(projectCuboidBox(kinectCamera(), behind));
  const Ellipsoid tooNear(mrpt::poses::CPose3D(0, 0, 0, 0, 0, 0), {0.5, 0.3, 0.04});
  EXPECT_FALSE(projectCuboidBox(kinectCamera(), tooNear)) << "ends 1 cm before the near plane";
}

TEST(BoxEdgePlanes, HaveTheBoxInsideAndItsSidesOnThem)
{
  const ImageBox box{100, 50, 400, 350};
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
  {
    const auto planes = boxEdgePlanes(camera, box);
    const Eigen::Vector3d inside = 2.0 * camera.ray(250, 200);
    const Eigen::Vector3d onEdge[4] = {
        camera.ray(100, 77), camera.ray(333, 50), camera.ray(400, 111), camera.ray(200, 350)};
    const Eigen::Vector3d outside[4] = {
        camera.ray(90, 200), camera.ray(250, 40), camera.ray(410, 200), camera.ray(250, 360)};
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(planes[i].n.norm(), 1, 1e-14);
      EXPECT_EQ(planes[i].d, 0) << "through the camera centre";
      EXPECT_NEAR(planes[i].signedDistance(3 * onEdge[i]), 0, 1e-12) << "edge " << i;
      EXPECT_GT(planes[i].signedDistance(inside), 0.1) << "edge " << i;
      EXPECT_LT(planes[i].signedDistance(outside[i]), -0.01) << "edge " << i;
    }
  }
}

TEST(BoxEdgePlanes, OfAnEllipsoidsBoxAreTangentToIt)
{
  RandomGeometry random(45);
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (int trial = 0; trial < 25; ++trial)
    {
      const Ellipsoid object = objectAhead(random);
      const auto box = projectEllipsoidBox(camera, object);
      ASSERT_TRUE(box);
      for (const Plane& plane : boxEdgePlanes(camera, *box))
      {
        const Eigen::Vector4d pi(plane.n.x(), plane.n.y(), plane.n.z(), plane.d);
        EXPECT_NEAR(pi.dot(object.dualQuadric() * pi), 0, 1e-9) << "(1.3)";
      }
    }
}
