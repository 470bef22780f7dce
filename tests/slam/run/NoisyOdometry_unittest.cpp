#include <gtest/gtest.h>

#include "DriftingCorridor.h"

using namespace quadmap;

// A long way there and back, with odometry that drifts several times as much as it claims: what is
// seen again must not become other things, and the user is told.
TEST(NoisyOdometry, IsFoundOutAndTrustedLess)
{
  const auto [result, report] = driftingCorridor(240, 180, 6, 18);
  ASSERT_TRUE(result.correction);
  EXPECT_GT(result.correction->stepNoise.position, 2);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("the odometry errs by more than it claims"), std::string::npos);
  EXPECT_EQ(report.objects->f1().value_or(0), 1);
  EXPECT_LT(report.trajectory->ateRmse, 0.15);
}
