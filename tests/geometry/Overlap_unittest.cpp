#include "quadmap/geometry/Overlap.h"

#include <gtest/gtest.h>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

namespace
{
Ellipsoid axisAligned(const Eigen::Vector3d& center, const Eigen::Vector3d& s)
{
  return Ellipsoid(poseOf(Eigen::Matrix3d::Identity(), center), s);
}

bool inCuboid(const Ellipsoid& object, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d q = object.rotation().transpose() * (p - object.center());
  return (q.cwiseAbs() - object.semiAxes()).maxCoeff() <= 0;
}

/** Share of the cuboid of a that is in the cuboid of b, by counting random points of a. */
double sampledShare(const Ellipsoid& a, const Ellipsoid& b, RandomGeometry& random, int samples)
{
  int hits = 0;
  for (int i = 0; i < samples; ++i)
    hits +=
        inCuboid(b, a.rotation() * random.vector(-1, 1).cwiseProduct(a.semiAxes()) + a.center());
  return double(hits) / samples;
}

double axisAlignedVolume(const Ellipsoid& a, const Ellipsoid& b)
{
  double volume = 1;
  for (int i = 0; i < 3; ++i)
    volume *= std::max(
        0.0, std::min(a.center()[i] + a.semiAxes()[i], b.center()[i] + b.semiAxes()[i]) -
                 std::max(a.center()[i] - a.semiAxes()[i], b.center()[i] - b.semiAxes()[i]));
  return volume;
}
}  // namespace

TEST(CuboidIntersectionVolume, AgreesWithMonteCarlo)
{
  RandomGeometry random(51);
  constexpr int kSamples = 40000;
  double largest = 0;
  for (int trial = 0; trial < 30; ++trial)
  {
    const Ellipsoid a = random.ellipsoid(random.vector(-0.2, 0.2));
    const Ellipsoid b = random.ellipsoid(random.vector(-0.2, 0.2));
    const double share = sampledShare(a, b, random, kSamples);
    largest = std::max(largest, share);
    EXPECT_NEAR(cuboidIntersectionVolume(a, b) / a.cuboidVolume(), share, 0.0125)
        << "5 standard deviations, 5 * 0.5 / sqrt(40000)";
  }
  EXPECT_GT(largest, 0.2);
}

TEST(CuboidIntersectionVolume, IsExactForAxisAlignedCuboids)
{
  RandomGeometry random(52);
  for (int trial = 0; trial < 300; ++trial)
  {
    const Ellipsoid a = axisAligned(random.vector(-0.3, 0.3), random.vector(0.1, 0.6));
    const Ellipsoid b = axisAligned(random.vector(-0.3, 0.3), random.vector(0.1, 0.6));
    const double exact = axisAlignedVolume(a, b);
    EXPECT_NEAR(cuboidIntersectionVolume(a, b), exact, 1e-13 + 1e-11 * exact);
    const mrpt::poses::CPose3D T =
        random.pose(10);  // the same pair, turned and far from the origin
    EXPECT_NEAR(
        cuboidIntersectionVolume(a.transformed(T), b.transformed(T)), exact, 1e-13 + 1e-9 * exact);
  }
}

TEST(CuboidIntersectionVolume, IsExactForSquarePrismsTurnedBy45Degrees)
{
  // Two squares of half side 1 at 45 degrees share a regular octagon of area 8 (sqrt(2) - 1).
  const Ellipsoid a = axisAligned({0, 0, 0}, {1, 1, 2});
  const Ellipsoid b(mrpt::poses::CPose3D(0, 0, 1, M_PI / 4, 0, 0), {1, 1, 2});
  EXPECT_NEAR(cuboidIntersectionVolume(a, b), 8 * (std::sqrt(2.0) - 1) * 3, 1e-12);
}

TEST(CuboidIntersectionVolume, OfACornerIsATetrahedron)
{
  // A big cuboid whose side has the normal (1,1,1)/sqrt(3) leaves a corner of legs 0.3 of the cube.
  const Eigen::Vector3d n = Eigen::Vector3d::Ones().normalized();
  const Eigen::Matrix3d R =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), n).toRotationMatrix();
  const double offset = n.dot(Eigen::Vector3d(1, 1, 0.7));  // the plane's distance to the origin
  const Ellipsoid big(poseOf(R, n * (offset + 10)), {10, 10, 10});
  EXPECT_NEAR(cuboidIntersectionVolume(Ellipsoid(), big), 0.3 * 0.3 * 0.3 / 6, 1e-12);
}

TEST(CuboidIntersectionVolume, OfIdenticalCuboidsIsTheirVolumeForEveryRelabeling)
{
  RandomGeometry random(53);
  const Eigen::Matrix3d cycle =
      (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();  // x -> y -> z -> x
  for (int trial = 0; trial < 100; ++trial)
  {
    const Ellipsoid a = random.ellipsoid(random.vector(-10, 10));
    EXPECT_NEAR(cuboidIntersectionVolume(a, a) / a.cuboidVolume(), 1, 1e-12);
    EXPECT_NEAR(cuboidIoU(a, a), 1, 1e-12);
    const Ellipsoid renamed(
        poseOf(a.rotation() * cycle, a.center()), cycle.transpose() * a.semiAxes());
    EXPECT_NEAR(cuboidIoU(a, renamed), 1, 1e-12);
  }
}

TEST(CuboidIntersectionVolume, IsContinuousWhereFacesNearlyCoincide)
{
  // Tilts from far below rounding to visible: the volume may change by the tilt, not by more.
  RandomGeometry random(54);
  const Ellipsoid a = random.ellipsoid({3, -5, 2});
  for (double tilt = 1e-18; tilt < 1e-3; tilt *= 3)
  {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Ellipsoid b(poseOf(a.rotation() * turn, a.center()), a.semiAxes());
    EXPECT_NEAR(cuboidIntersectionVolume(a, b) / a.cuboidVolume(), 1, 1e-11 + 12 * tilt)
        << "tilt " << tilt;
  }
}

TEST(CuboidIntersectionVolume, IsZeroForTouchingAndSeparateCuboids)
{
  const Ellipsoid a = axisAligned({0, 0, 0}, {0.5, 0.5, 0.5});
  EXPECT_NEAR(cuboidIntersectionVolume(a, axisAligned({1, 0, 0}, {0.5, 0.5, 0.5})), 0, 1e-15);
  EXPECT_NEAR(cuboidIntersectionVolume(a, axisAligned({1, 1, 0}, {0.5, 0.5, 0.5})), 0, 1e-15);
  EXPECT_NEAR(cuboidIntersectionVolume(a, axisAligned({1, 1, 1}, {0.5, 0.5, 0.5})), 0, 1e-15);
  EXPECT_EQ(cuboidIntersectionVolume(a, axisAligned({1.1, 0, 0}, {0.5, 0.5, 0.5})), 0);
  EXPECT_EQ(cuboidIoU(a, axisAligned({30, 0, 0}, {0.5, 0.5, 0.5})), 0);
}

TEST(CuboidIntersectionVolume, OfAContainedCuboidIsItsOwn)
{
  RandomGeometry random(55);
  const Ellipsoid large(random.pose(3), {2, 3, 4});
  const Ellipsoid small(poseOf(random.rotation(), large.center()), {0.1, 0.2, 0.3});
  EXPECT_NEAR(cuboidIntersectionVolume(large, small), small.cuboidVolume(), 1e-14);
  EXPECT_NEAR(cuboidIntersectionVolume(small, large), small.cuboidVolume(), 1e-14);
}

TEST(CuboidIntersectionVolume, IsSymmetricAlsoForThinPlates)
{
  RandomGeometry random(56);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Ellipsoid a(random.pose(0.1), {1, 0.5, 1e-4}), b(random.pose(0.1), {0.5, 1e-4, 0.7});
    const double ab = cuboidIntersectionVolume(a, b), ba = cuboidIntersectionVolume(b, a);
    EXPECT_NEAR(ab, ba, 1e-9 * std::max(ab, ba) + 1e-18);
  }
}

TEST(CuboidIoU, OfAShiftedCubeIsTheSharedShare)
{
  const Ellipsoid a = axisAligned({0, 0, 0}, {0.5, 0.5, 0.5});
  EXPECT_NEAR(cuboidIoU(a, axisAligned({0.5, 0, 0}, {0.5, 0.5, 0.5})), 0.5 / 1.5, 1e-14);
}

TEST(AlignedIoU, IsTheIoUOfConcentricAxisAlignedCuboids)
{
  RandomGeometry random(57);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Vector3d a = random.vector(0.1, 1), b = random.vector(0.1, 1);
    const double exact = cuboidIoU(axisAligned({0, 0, 0}, a), axisAligned({0, 0, 0}, b));
    EXPECT_NEAR(alignedIoU(a, b), exact, 1e-12);
    EXPECT_NEAR(alignedIoU(2 * a, 2 * b), exact, 1e-12) << "full or half sizes";
  }
  EXPECT_DOUBLE_EQ(alignedIoU({1, 2, 3}, {1, 2, 3}), 1);
  EXPECT_DOUBLE_EQ(alignedIoU({1, 1, 1}, {2, 2, 2}), 1.0 / 8);
}
