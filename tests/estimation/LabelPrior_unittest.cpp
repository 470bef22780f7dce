#include "quadmap/estimation/LabelPrior.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

TEST(SizeDeviation, ComparesSizesInTheOrderOfLength)
{
  LabelProperties label;
  label.typicalSize = {0.8, 0.4, 1.6};
  label.sizeSpread = 0.5;
  const auto deviation = [&](const Eigen::Vector3d& size, ObjectFreedom freedom)
  { return sizeDeviation(Ellipsoid({}, 0.5 * size), label, freedom); };
  EXPECT_NEAR(deviation({0.8, 0.4, 1.6}, ObjectFreedom::Upright), 0, 1e-12);
  EXPECT_NEAR(deviation({0.4, 0.8, 1.6}, ObjectFreedom::Upright), 0, 1e-12);
  EXPECT_NEAR(deviation({0.8, 0.4, 3.2}, ObjectFreedom::Upright), std::log(2) / 0.5, 1e-12);
  EXPECT_NEAR(deviation({0.8, 0.2, 1.6}, ObjectFreedom::Upright), std::log(2) / 0.5, 1e-12);
  // An upright object that lies is another one; a free one has just other names.
  EXPECT_NEAR(deviation({1.6, 0.8, 0.4}, ObjectFreedom::Upright), std::log(4) / 0.5, 1e-12);
  EXPECT_NEAR(deviation({1.6, 0.8, 0.4}, ObjectFreedom::Free), 0, 1e-12);
}
