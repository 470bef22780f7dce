#include <gtest/gtest.h>

#include "DriftingCorridor.h"
#include "backend/OdometryDrift.h"
#include "backend/SightedObjects.h"
#include "quadmap/constellation/Doubles.h"

using namespace quadmap;

// A long way there and back, with odometry that drifts ten times as much as it claims. The things
// on the way back do not overlap those on the way there, and are other ones until all are compared.
// Whether a run meets its own things as new ones hangs on single views: in one of the two it does.
TEST(LoopClosure, MakesDoublesOne)
{
  int closed = 0;
  for (const unsigned width : {320, 160})
  {
    const auto [result, report] = driftingCorridor(width, 3 * width / 4, 10, 9);
    closed += static_cast<int>(result.loops.closed);
    EXPECT_FALSE(result.loops.open) << width;
    EXPECT_GE(report.objects->f1().value_or(0), 0.9) << width << "; 0.40 with the doubles";
    EXPECT_LT(report.trajectory->ateRmse, 0.15) << width << " [m]; 0.45 with the doubles";
  }
  EXPECT_GE(closed, 1);
}

// The odometry drifts as far as from one room to the other, so that in some of the runs it alone
// would take them for one. What the robot passes in between tells that they are two.
TEST(LoopClosure, LeavesRoomsFurnishedAlikeTwo)
{
  int allowed = 0;
  for (const std::uint64_t seed : {2, 3, 4})
  {
    auto scene = simulator::readScene(QUADMAP_SOURCE_DIR "/tests/slam/run/RoomsAlike.ini");
    scene.options.resize(160, 120);
    const auto [result, report] = driftingRun(std::move(scene), 10, seed);
    EXPECT_EQ(result.loops.closed, 0) << seed;
    EXPECT_LT(report.trajectory->ateRmse, 0.3) << seed << " [m]; 0.67 with one room for both";
    const OdometryDrift odometry(result.keyframes, result.correction->stepNoise.atLeastClaimed());
    const auto sighted = sightedObjects(result);
    const auto labels = LabelTable::installed();
    const ConstellationOptions options;
    const DoublesRules rules{sighted, labels, options};
    const auto candidates = doublesCandidates(rules, odometry);
    allowed += findDoubles(rules, candidates, odometry, [] { return false; }) ? 1 : 0;
  }
  EXPECT_GE(allowed, 1);
}

TEST(LoopClosure, LeavesARunThatCanGoOnInAMap)
{
  const auto earlier = driftingCorridor(160, 120, 1, 9);
  const auto [result, report] =
      driftingCorridor(160, 120, 10, 9, std::make_shared<CQuadricObjectMap>(earlier.result.map));
  EXPECT_GE(result.loops.closed, 1);
  ASSERT_TRUE(result.continuation);
  EXPECT_GE(result.continuation->match.pairs.size(), 6U) << "of seven things";
  EXPECT_TRUE(result.continuation->removed.empty());
  EXPECT_TRUE(result.continuation->added.empty());
  EXPECT_EQ(report.objects->f1().value_or(0), 1);
  EXPECT_LT(report.trajectory->ateRmse, 0.15) << "[m]";
}
