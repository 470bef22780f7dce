#include <gtest/gtest.h>

#include "DriftingCorridor.h"

using namespace quadmap;

// A long way there and back, with odometry that drifts ten times as much as it claims. The things
// on the way back do not overlap those on the way there, and are other ones until all are compared.
TEST(LoopClosure, MakesDoublesOne)
{
  const auto [result, report] = driftingCorridor(320, 240, 10, 3);
  EXPECT_GE(result.loops.closed, 1);
  EXPECT_FALSE(result.loops.open);
  EXPECT_GE(report.objects->f1().value_or(0), 0.8) << "0.33 with the doubles";
  EXPECT_LT(report.trajectory->ateRmse, 0.2) << "[m]; 0.92 with the doubles";
}
