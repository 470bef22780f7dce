#include "camera/Silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../SceneFixture.h"
#include "quadmap/simulator/SimulatedDetector.h"

namespace quadmap::simulator
{
namespace
{
/** Number of steps of the oracle's grid along each direction of a surface. */
int stepsOn(const Primitive& solid) { return solid.shape == Shape::Box ? 40 : 300; }

/** A grid over the surface, in `prim`, with its corners, rims and poles. */
std::vector<Eigen::Vector3d> surfaceGrid(const Primitive& solid)
{
  const int steps = stepsOn(solid);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
    {
      const double a = 2.0 * i / steps - 1, b = 2.0 * j / steps - 1;
      const double angle = M_PI * a, lift = 0.5 * M_PI * b;
      if (solid.shape == Shape::Ellipsoid)
        points.emplace_back(
            std::cos(lift) * std::cos(angle), std::cos(lift) * std::sin(angle), std::sin(lift));
      else if (solid.shape == Shape::Cylinder)
      {
        points.emplace_back(std::cos(angle), std::sin(angle), b);
        for (const double end : {-1.0, 1.0})
          points.emplace_back(
              0.5 * (b + 1) * std::cos(angle), 0.5 * (b + 1) * std::sin(angle), end);
      }
      else
        for (int axis = 0; axis < 3; ++axis)
          for (const double end : {-1.0, 1.0})
          {
            Eigen::Vector3d p;
            p[axis] = end;
            p[(axis + 1) % 3] = a;
            p[(axis + 2) % 3] = b;
            points.push_back(p);
          }
    }
  for (auto& p : points) p = p.cwiseProduct(solid.halfSize);
  return points;
}

/** Box of the points of the surface that are in front of the camera, or nothing without any. */
std::optional<ImageBox> boundsOfSurface(
    const Primitive& solid, const mrpt::poses::CPose3D& T_camera_prim, const PinholeCamera& camera)
{
  constexpr double kNear = 0.01;
  ImageBox box{1e9, 1e9, -1e9, -1e9};
  const auto grow = [&](const Eigen::Vector3d& p)
  {
    const Eigen::Vector2d q = camera.project({-p.y(), -p.z(), p.x()});
    box = {
        std::min(box.x1, q.x()), std::min(box.y1, q.y()), std::max(box.x2, q.x()),
        std::max(box.y2, q.y())};
  };
  auto points = surfaceGrid(solid);
  for (auto& p : points) p = transformed(T_camera_prim, p);
  const auto columns = static_cast<std::size_t>(stepsOn(solid) + 1);
  const std::size_t column = points.size() / columns, row = column / columns;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3d& p = points[i];
    if (p.x() >= kNear) grow(p);
    for (const std::size_t next : {i + row, i + column})
    {
      // Where the way to the next point (inside: solids are convex) crosses the near plane.
      if (next >= points.size() || (points[next].x() < kNear) == (p.x() < kNear)) continue;
      const Eigen::Vector3d step = points[next] - p;
      grow(p + step * ((kNear - p.x()) / step.x()));
    }
  }
  if (box.x1 > box.x2) return std::nullopt;
  return box;
}

struct Edge
{
  double exact, sampled;
  double sign;  // +1 when samples are at greater values
};

std::vector<Edge> edgesOf(const ImageBox& exact, const ImageBox& sampled)
{
  return {
      {exact.x1, sampled.x1,  1},
      {exact.y1, sampled.y1,  1},
      {exact.x2, sampled.x2, -1},
      {exact.y2, sampled.y2, -1}
  };
}

class SolidOutline : public ::testing::TestWithParam<Shape>
{
 protected:
  std::mt19937 random_{7};
  double uniform(double a, double b)
  {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  Primitive solid()
  {
    Primitive p;
    p.shape = GetParam();
    p.halfSize = {uniform(0.02, 0.8), uniform(0.02, 0.8), uniform(0.02, 0.8)};
    return p;
  }
  /** \param nearest, farthest Range of the distance ahead of the camera [m]. */
  mrpt::poses::CPose3D pose(double nearest, double farthest)
  {
    const double x = uniform(nearest, farthest);
    return {
        x,
        uniform(-1, 1),
        uniform(-1, 1),
        uniform(-M_PI, M_PI),
        uniform(-M_PI / 2, M_PI / 2),
        uniform(-M_PI, M_PI)};
  }
};

TEST_P(SolidOutline, EnclosesTheSampledSurfaceTightly)
{
  const PinholeCamera camera = CameraOptions().pinhole();
  for (int i = 0; i < 25; ++i)
  {
    const Primitive shape = solid();
    const mrpt::poses::CPose3D T = pose(1.6, 4);
    const auto exact = outlineBox(shape, T, camera);
    const auto sampled = boundsOfSurface(shape, T, camera);
    ASSERT_TRUE(exact && sampled);
    for (const auto& edge : edgesOf(*exact, *sampled))
    {
      EXPECT_GE(edge.sign * (edge.sampled - edge.exact), -1e-6) << "nothing sticks out";
      // Half a step of the grid, 0.6 degrees, moves the extreme of a round thing by 1.4e-5 of its
      // radius, here at most 500 px.
      EXPECT_LT(edge.sign * (edge.sampled - edge.exact), 0.05);
    }
  }
}

TEST_P(SolidOutline, ReachesBehindTheCamera)
{
  const PinholeCamera camera = CameraOptions().pinhole();
  unsigned compared = 0, crossing = 0;
  for (int i = 0; i < 60; ++i)
  {
    const Primitive shape = solid();
    const mrpt::poses::CPose3D T = pose(-0.6, 0.6);
    const auto exact = outlineBox(shape, T, camera);
    const auto sampled = boundsOfSurface(shape, T, camera);
    if (!sampled) continue;
    ASSERT_TRUE(exact);
    ++crossing;
    for (const auto& edge : edgesOf(*exact, *sampled))
    {
      // The prism of 512 sides that stands for a cylinder is 2e-5 smaller, the grid another 1.4e-5,
      // of at most 0.8 m, seen from 0.01 m away at the nearest: 1.5 px.
      EXPECT_GE(edge.sign * (edge.sampled - edge.exact), -1.5);
      EXPECT_LT(edge.sign * (edge.sampled - edge.exact), 1.5 + 1e-3 * std::abs(edge.exact));
      compared += std::abs(edge.exact) < 1500;
    }
  }
  EXPECT_GT(crossing, 25U);
  EXPECT_GT(compared, 12U);
  EXPECT_FALSE(outlineBox(solid(), {-3, 0, 0, 0.3, 0, 0}, camera)) << "all of it is behind";
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, SolidOutline, ::testing::Values(Shape::Box, Shape::Cylinder, Shape::Ellipsoid));

/** Box of the pixels of an object alone in its room, in an image with `margin` more pixels on each
 * side. */
std::optional<ImageBox> pixelsAlone(
    const Scene& scene,
    std::size_t object,
    const mrpt::poses::CPose3D& pose,
    const PinholeCamera& camera,
    unsigned margin)
{
  Scene alone = scene;
  alone.objects = {scene.objects[object]};
  PinholeCamera wide = camera;
  wide.width += 2 * margin;
  wide.height += 2 * margin;
  wide.cx += margin;
  wide.cy += margin;
  const RenderedFrame frame = RayCaster(alone, wide).render(pose);
  DetectorOptions everything;
  everything.minVisible = 0;
  everything.minSize = 1;
  const auto visible = visibleObjects(alone, frame, everything);
  if (visible.empty()) return std::nullopt;
  const double m = margin;
  const ImageBox box = visible[0].box;
  return ImageBox{box.x1 - m, box.y1 - m, box.x2 - m, box.y2 - m};
}

TEST(VisibleObjects, OutlineIsThatOfTheObjectAloneInAWiderImage)
{
  const Scene scene = homeScene();
  const PinholeCamera camera = smallCamera();
  const unsigned margin = 100;
  unsigned cut = 0, hidden = 0, compared = 0;
  for (const auto& pose :
       {mrpt::poses::CPose3D(-1.9, 1.2, 1.4, -0.4, 0.3, 0.05),
        mrpt::poses::CPose3D(-0.1, -1.9, 1.5, 1.3, 0.5, -0.1),
        mrpt::poses::CPose3D(0.2, 1.9, 1.3, -1.5, 0.3, 0.1)})
  {
    const RenderedFrame frame = RayCaster(scene, camera).render(pose);
    for (const auto& seen : visibleObjects(scene, frame, DetectorOptions()))
    {
      const auto alone = pixelsAlone(scene, seen.object, pose, camera, margin);
      ASSERT_TRUE(alone);
      const ImageBox visibleBox = seen.box;
      for (const auto& edge : edgesOf(seen.outline, *alone))
      {
        if (edge.exact < -90.0 || edge.exact > 250.0) continue;  // beyond the wider image, perhaps
        ++compared;
        // Pixels have whole coordinates, and a corner may pass between two rows of them.
        EXPECT_GE(edge.sign * (edge.sampled - edge.exact), -1e-6)
            << scene.objects[seen.object].name;
        EXPECT_LT(edge.sign * (edge.sampled - edge.exact), 2) << scene.objects[seen.object].name;
      }
      const bool atBorder =
          visibleBox.x1 == 0 || visibleBox.y1 == 0 || visibleBox.x2 == 159 || visibleBox.y2 == 119;
      const auto edges = edgesOf(seen.outline, visibleBox);
      const bool shorter = std::any_of(
          edges.begin(), edges.end(),
          [](const Edge& e) { return e.sign * (e.sampled - e.exact) > 2; });
      cut += atBorder && shorter;
      hidden += !atBorder && shorter;
    }
  }
  EXPECT_GT(compared, 40U);
  EXPECT_GT(cut, 2U) << "by the image";
  EXPECT_GT(hidden, 0U) << "by something nearer";
}

}  // namespace
}  // namespace quadmap::simulator
