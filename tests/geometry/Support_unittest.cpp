#include "quadmap/geometry/Support.h"

#include <gtest/gtest.h>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

namespace
{
constexpr double kExponents[] = {1.0, 1.2, 1.5, 1.9, 2.0};

/** The definition without smoothing. */
double plainSupport(const Eigen::Vector3d& n, const Eigen::Vector3d& s, double q)
{
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::pow(std::abs(s[i] * n[i]), q);
  return std::pow(sum, 1 / q);
}
}  // namespace

TEST(SupportFunction, OfTheEllipsoidIsTheFarthestPointOfItsSurface)
{
  RandomGeometry random(31);
  const Eigen::Vector3d s(0.3, 0.5, 0.8);
  for (int trial = 0; trial < 5; ++trial)
  {
    const Eigen::Vector3d n = random.direction();
    double farthest = 0;
    for (int i = 0; i < 40000; ++i)
      farthest = std::max(farthest, n.dot(s.cwiseProduct(random.direction())));
    const double h = supportFunction<double>(n, s, 2);
    EXPECT_LE(farthest, h + 1e-12);
    // 40000 directions: the nearest is within acos(1 - 10/40000) = 0.022 rad, which costs < h 3e-4.
    EXPECT_NEAR(farthest, h, 1e-3);
  }
}

TEST(SupportFunction, OfTheCuboidIsItsFarthestCorner)
{
  RandomGeometry random(32);
  const Eigen::Vector3d s(0.3, 0.5, 0.8);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Vector3d n = random.direction();
    const double corner = (Ellipsoid({}, s).cuboidCorners().transpose() * n).maxCoeff();
    EXPECT_NEAR(supportFunction<double>(n, s, 1), corner, 3 * kSupportSmoothing * s.norm())
        << "each |x| is at most k larger";
  }
}

TEST(SupportFunction, IsSmoothedByAtMostTheSmoothing)
{
  RandomGeometry random(33);
  for (double q : kExponents)
    for (int trial = 0; trial < 100; ++trial)
    {
      const Eigen::Vector3d n = random.direction(), s = random.vector(0.05, 1);
      const double smooth = supportFunction<double>(n, s, q), plain = plainSupport(n, s, q);
      EXPECT_GE(smooth, plain - 1e-12);
      EXPECT_LE(smooth, plain + 3 * kSupportSmoothing * s.norm()) << "q " << q;
    }
}

TEST(SupportFunction, LiesBetweenEllipsoidAndCuboid)
{
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, 3).normalized(), s(0.3, 0.5, 0.4);
  double last = supportFunction<double>(n, s, 1);
  for (double q : {1.2, 1.5, 1.9, 2.0})
  {
    const double h = supportFunction<double>(n, s, q);
    EXPECT_LT(h, last) << "q " << q;
    last = h;
  }
}

TEST(SupportWithDerivatives, AgreesWithTheTemplateAndItsNumericDerivatives)
{
  RandomGeometry random(34);
  for (double q : kExponents)
    for (int trial = 0; trial < 100; ++trial)
    {
      Eigen::Vector3d n = random.direction();
      if (trial % 4 == 0) n = Eigen::Vector3d::Unit(trial / 4 % 3);  // where |.| has its kinks
      const Eigen::Vector3d s = random.vector(0.05, 1);
      const SupportWithDerivatives d = supportWithDerivatives(n, s, q);
      EXPECT_NEAR(d.h, supportFunction<double>(n, s, q), 1e-14);
      // Central differences: step^2 h''' / 6 < 1e-6 where the kink's radius is 1e-3 |s|.
      const double step = 1e-7;
      for (int i = 0; i < 3; ++i)
      {
        const Eigen::Vector3d e = step * Eigen::Vector3d::Unit(i);
        const double d_n =
            (supportFunction<double>(n + e, s, q) - supportFunction<double>(n - e, s, q)) /
            (2 * step);
        const double d_s =
            (supportFunction<double>(n, s + e, q) - supportFunction<double>(n, s - e, q)) /
            (2 * step);
        EXPECT_NEAR(d.d_n[i], d_n, 1e-6) << "q " << q << " n " << n.transpose();
        EXPECT_NEAR(d.d_s[i], d_s, 1e-6) << "q " << q << " n " << n.transpose();
      }
    }
}
