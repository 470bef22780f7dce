#include "quadmap/estimation/RepeatedErrors.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
const Eigen::Vector3d kCenter(1, 2, 0.5);

Eigen::Vector3d cameraAt(double angle, double range)
{
  return kCenter + range * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
}
}  // namespace

TEST(RepeatedShare, FallsWithTheAngleBetweenTheViewsAndStaysAboveThatOfAnyTwo)
{
  const EstimatorOptions options;
  const auto share = [&](double angle, double range)
  { return repeatedShare(cameraAt(0, 2), cameraAt(angle, range), kCenter, options); };
  EXPECT_DOUBLE_EQ(share(0, 2), options.repeatedThere);
  EXPECT_NEAR(
      share(options.repeatedAngle, 2),
      options.repeatedAnywhere + (options.repeatedThere - options.repeatedAnywhere) / std::exp(1),
      0.01);
  EXPECT_GT(share(0.1, 2), share(0.2, 2));
  EXPECT_NEAR(share(M_PI, 2), options.repeatedAnywhere, 0.01);
  // Nearer by a small part is as far as that angle aside.
  EXPECT_NEAR(share(0, 2.1), share(0.05, 2), 2e-3);
  EXPECT_DOUBLE_EQ(
      repeatedShare(cameraAt(0, 3), cameraAt(1, 2), kCenter, options),
      repeatedShare(cameraAt(1, 2), cameraAt(0, 3), kCenter, options));
}
