#include <gtest/gtest.h>

#include "../SceneFixture.h"

namespace quadmap::simulator
{
namespace
{
constexpr Shape kShapes[] = {Shape::Box, Shape::Cylinder, Shape::Ellipsoid};

Primitive sample(Shape shape)
{
  Primitive primitive;
  primitive.shape = shape;
  primitive.halfSize = Eigen::Vector3d(0.4, 0.25, 0.7);
  primitive.T_obj_prim = mrpt::poses::CPose3D(0.1, -0.2, 0.3, 0.5, -0.3, 0.8);
  return primitive;
}

/** The first t at which the ray is inside, by small steps and bisection. */
std::optional<double> marchedEntry(
    const Primitive& primitive, const Eigen::Vector3d& o, const Eigen::Vector3d& d)
{
  const double step = 0.002;
  for (double t = 0; t < 6; t += step)
  {
    if (!isInside(primitive, o + t * d)) continue;
    double outside = t - step, inside = t;
    for (int i = 0; i < 40; ++i)
    {
      const double middle = 0.5 * (outside + inside);
      (isInside(primitive, o + middle * d) ? inside : outside) = middle;
    }
    return inside;
  }
  return std::nullopt;
}

TEST(Primitive, RaysEnterWhereMarchingAlongThemDoes)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Shape shape : kShapes)
  {
    const Primitive primitive = sample(shape);
    int hits = 0, misses = 0;
    for (int i = 0; i < 400; ++i)
    {
      const Eigen::Vector3d o =
          3 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
      const Eigen::Vector3d aim(uniform(random), uniform(random), uniform(random));
      const Eigen::Vector3d d = (0.8 * aim - o).normalized();
      const auto t = intersect(primitive, o, d);
      const auto expected = marchedEntry(primitive, o, d);
      if (!expected && t)  // cut so briefly that the marcher stepped over it
        EXPECT_FALSE(isInside(primitive, o + (*t + 0.002) * d));
      else
        EXPECT_EQ(bool(expected), bool(t));
      EXPECT_NEAR(expected && t ? *expected : 0, expected && t ? *t : 0, 1e-9);
      ++(t ? hits : misses);
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(misses, 50);
  }
}

TEST(Primitive, RaysAlongTheAxesAndFromInsideAreNoSpecialCases)
{
  for (const Shape shape : kShapes)
  {
    const Primitive primitive = sample(shape);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d d = Eigen::Vector3d::Unit(axis);
      const auto t = intersect(primitive, -2 * d, d);
      ASSERT_TRUE(t);
      EXPECT_NEAR(2 - primitive.halfSize[axis], *t, 1e-12);
      EXPECT_FALSE(intersect(primitive, 2 * d, d)) << "behind the start";
      EXPECT_FALSE(intersect(primitive, Eigen::Vector3d::Zero(), d)) << "from inside";
      const Eigen::Vector3d beside = Eigen::Vector3d::Unit((axis + 1) % 3);
      EXPECT_FALSE(intersect(primitive, beside - 2 * d, d)) << "parallel, outside";
    }
  }
}

TEST(Primitive, NormalsPointOutOfTheSurface)
{
  std::mt19937 random(8);
  for (const Shape shape : kShapes)
  {
    const Primitive primitive = sample(shape);
    for (int i = 0; i < 300; ++i)
    {
      const Eigen::Vector3d p = surfacePoint(primitive, random);
      const Eigen::Vector3d n = surfaceNormal(primitive, p);
      EXPECT_NEAR(1, n.norm(), 1e-12);
      EXPECT_FALSE(isInside(primitive, p + 1e-6 * n));
      EXPECT_TRUE(isInside(primitive, p - 1e-6 * n));
      // No neighbour of the surface is higher along the normal: all three solids are convex.
      for (int k = 0; k < 20; ++k) EXPECT_LT(n.dot(surfacePoint(primitive, random) - p), 1e-9);
    }
  }
}

TEST(Primitive, ExtentIsTheTightBoxOfTheSurface)
{
  std::mt19937 random(9);
  for (const Shape shape : kShapes)
  {
    const Primitive primitive = sample(shape);
    const auto& t = primitive.T_obj_prim;
    const Eigen::Vector3d center(t.x(), t.y(), t.z());
    Eigen::Vector3d reach = Eigen::Vector3d::Zero();
    for (int i = 0; i < 200000; ++i)
    {
      const Eigen::Vector3d p = transformed(t, surfacePoint(primitive, random));
      reach = reach.cwiseMax((p - center).cwiseAbs());
    }
    const Eigen::Vector3d half = halfExtent(primitive);
    EXPECT_LE((reach - half).maxCoeff(), 1e-12) << "no sample outside";
    // 2e5 samples come within about (2e5)^(-1/2) of a corner, times the size of 0.7 m.
    EXPECT_LT((half - reach).maxCoeff(), 0.012);
  }
}

}  // namespace
}  // namespace quadmap::simulator
