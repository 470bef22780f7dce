#include "quadmap/perception/HiddenPart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace quadmap
{
namespace
{
constexpr ObjectSide kEachSide[] = {ObjectSide::Top, ObjectSide::Bottom, ObjectSide::Lateral};

/** Of a thing 100 px high and wide, whose cuboid fits its box. */
HiddenEvidence nothingHidden()
{
  HiddenEvidence e;
  e.length_px = e.size_px = 100;
  e.cuboidFit = 0.9;
  return e;
}

TEST(HiddenPart, NothingSpeaksAgainstAFreeEdge)
{
  for (const auto side : kEachSide) EXPECT_LT(hiddenProbability(side, nothingHidden()), 0.02);
}

TEST(HiddenPart, ACuboidThatReachesBeyondTheEdgeSpeaksAgainstIt)
{
  HiddenEvidence e = nothingHidden();
  e.cuboidBeyond_px = 30;
  for (const auto side : kEachSide)
    EXPECT_GT(hiddenProbability(side, e), hiddenProbability(side, nothingHidden()));
}

TEST(HiddenPart, ACuboidThatIsNotTheObjectsTellsNothing)
{
  HiddenEvidence none = nothingHidden();
  none.cuboidFit = 0;
  HiddenEvidence e = none;
  e.cuboidBeyond_px = 60;
  for (const auto side : kEachSide)
    EXPECT_EQ(hiddenProbability(side, e), hiddenProbability(side, none));
}

TEST(HiddenPart, ACloudThatGoesOnOutsideExplainsItsCuboid)
{
  HiddenEvidence e = nothingHidden();
  e.cuboidBeyond_px = 30;
  HiddenEvidence leaking = e;
  leaking.cloudShort_px = -30;
  for (const auto side : kEachSide)
  {
    EXPECT_LT(hiddenProbability(side, leaking), hiddenProbability(side, e));
    EXPECT_DOUBLE_EQ(hiddenProbability(side, leaking), hiddenProbability(side, nothingHidden()));
  }
}

TEST(HiddenPart, ACuboidMayErrByMoreTheLargerTheThing)
{
  HiddenEvidence small = nothingHidden(), large = nothingHidden();
  small.cuboidBeyond_px = large.cuboidBeyond_px = 15;
  large.size_px = 400;
  EXPECT_LT(
      hiddenProbability(ObjectSide::Lateral, large), hiddenProbability(ObjectSide::Lateral, small));
}

TEST(HiddenPart, AThingWhoseSupportIsUnknownMayGoOnBelow)
{
  HiddenEvidence e = nothingHidden();
  e.coverageUnsupported = 0.9;
  EXPECT_GT(
      hiddenProbability(ObjectSide::Bottom, e),
      3 * hiddenProbability(ObjectSide::Bottom, nothingHidden()));
}

TEST(HiddenPart, SomethingNearerAlongALongSideIsMoreThanChance)
{
  HiddenEvidence e = nothingHidden();
  e.nearer = 0.5;
  HiddenEvidence longer = e;
  longer.length_px = 400;
  EXPECT_GT(
      hiddenProbability(ObjectSide::Lateral, longer), hiddenProbability(ObjectSide::Lateral, e));
}

TEST(HiddenPart, TheProbabilityIsThatOfItsTerms)
{
  HiddenEvidence e = nothingHidden();
  e.nearer = 0.7;
  e.cuboidBeyond_px = 20;
  e.tooLow = 2;
  e.anyContact = true;
  for (const auto side : kEachSide)
  {
    const auto terms = hiddenTerms(side, e);
    ASSERT_FALSE(terms.empty());
    EXPECT_EQ(terms.front().evidence, 1);  // the constant
    double logOdds = 0;
    for (const auto& term : terms) logOdds += term.evidence * term.weight;
    const double p = hiddenProbability(side, e);
    EXPECT_NEAR(std::log(p / (1 - p)), logOdds, 1e-9);
  }
}

}  // namespace
}  // namespace quadmap
