#include "quadmap/estimation/ExistenceLooks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
const ExistenceOptions kOptions;
const Eigen::Vector3d kObject(0, 0, 0);

/** A place on a circle around the object. \param angle Where [rad]. */
Eigen::Vector3d placeAt(double angle) { return {3 * std::cos(angle), 3 * std::sin(angle), 0}; }

/** Looks at 10 Hz. \param step Angle from one look to the next [rad]. */
ExistenceLooks looks(const std::vector<bool>& seen, double step, double time = 0)
{
  ExistenceLooks result;
  for (std::size_t i = 0; i < seen.size(); ++i)
    result.add(
        {placeAt(step * static_cast<double>(i)), time + 0.1 * static_cast<double>(i), seen[i]},
        kObject, kOptions);
  return result;
}

std::vector<bool> alternating(std::size_t n)
{
  std::vector<bool> seen;
  for (std::size_t i = 0; i < n; ++i) seen.push_back(i % 2 == 0);
  return seen;
}

double logOdds(const ExistenceLooks& looks)
{
  return looks.logOdds(kOptions.detectionProbability, kOptions);
}
}  // namespace

TEST(ExistenceLooks, FromOnePlaceCountAsFewHoweverManyTheyAre)
{
  const double most = 1 / (1 - kOptions.repeatedViewWeight);
  for (const std::size_t n : {5u, 50u, 400u})
  {
    const ExistenceLooks seen = looks(std::vector<bool>(n, true), 0);
    const ExistenceLooks missed = looks(std::vector<bool>(n, false), 0);
    EXPECT_LT(seen.independent(kOptions).seen, most);
    EXPECT_LT(logOdds(seen), kOptions.confirmLogOdds) << "a steady false alarm, " << n;
    EXPECT_NEAR(seen.independent(kOptions).seen, missed.independent(kOptions).missed, 1e-12);
  }
}

TEST(ExistenceLooks, AnEarlierLookIsAVisitOfItsOwn)
{
  ExistenceLooks late = looks({true}, 0, 1000), early = late;
  late.add({placeAt(0), 1000.1, true}, kObject, kOptions);
  early.add({placeAt(0), 100, true}, kObject, kOptions);  // records may come out of order
  EXPECT_NEAR(early.independent(kOptions).seen, 2, 1e-12);
  EXPECT_LT(late.independent(kOptions).seen, 1.5);
}

TEST(ExistenceLooks, DetectionsAndMissesOfOnePlaceWeighAlike)
{
  auto seen = alternating(400);
  const ExistenceLooks inTurn = looks(seen, 0);
  EXPECT_GT(logOdds(inTurn), 0) << "a detector that finds it every second time has found it";
  std::shuffle(seen.begin(), seen.end(), std::mt19937(1));
  EXPECT_NEAR(logOdds(looks(seen, 0)), logOdds(inTurn), 1e-9) << "in any order";
  const LookCounts counts = inTurn.independent(kOptions);
  EXPECT_NEAR(counts.seen, counts.missed, 1e-12);
}

TEST(ExistenceLooks, FromFarApartCountInFull)
{
  const ExistenceLooks apart = looks({true, false, true}, 0.5);
  EXPECT_NEAR(apart.independent(kOptions).seen, 2, 1e-12);
  EXPECT_NEAR(apart.independent(kOptions).missed, 1, 1e-12);
  // Chords of 0.05 rad are half of the angle, and 0.1 s are a small part of the time between
  // visits.
  const double share = 1 / (1 + 0.75 * 0.5 * (1 - 0.1 / kOptions.independentViewTime));
  EXPECT_NEAR(looks({true, true}, 0.05).independent(kOptions).seen, 2 * share, 1e-3);
}

TEST(ExistenceLooks, FromOnePlaceLongAfterwardsCountInFull)
{
  ExistenceLooks back;
  for (const double time : {0.0, 2 * kOptions.independentViewTime})
    back.add({placeAt(0), time, true}, kObject, kOptions);
  EXPECT_NEAR(back.independent(kOptions).seen, 2, 1e-12);
}

TEST(ExistenceLooks, EvidenceCanTurn)
{
  ExistenceLooks gone = looks(std::vector<bool>(60, true), 0.1);
  EXPECT_EQ(logOdds(gone), kOptions.maxLogOdds);
  for (int i = 0; i < 60; ++i)
    gone.add({placeAt(0.1 * i), 100 + 0.1 * i, false}, kObject, kOptions);
  EXPECT_LT(logOdds(gone), -kOptions.confirmLogOdds);
}

TEST(ExistenceLooks, WhatWasAlwaysSeenAndThenIsSeenEveryThirdTimeIsStillThere)
{
  std::vector<bool> seen(40, true);
  for (int i = 0; i < 24; ++i) seen.push_back(i % 3 == 2);
  constexpr double kOfGoodDetector = 0.9;
  EXPECT_GT(looks(seen, 0.1).logOdds(kOfGoodDetector, kOptions), kOptions.confirmLogOdds);
  seen.insert(seen.end(), 24, false);
  EXPECT_LT(looks(seen, 0.1).logOdds(kOfGoodDetector, kOptions), -kOptions.confirmLogOdds);
}

TEST(ExistenceLooks, TellWhatAReturnSaid)
{
  const auto after = [](const ExistenceLooks& looks)
  { return looks.afterReturn(kOptions.detectionProbability, kOptions); };
  const std::vector<bool> often(10, true);
  ExistenceLooks twice = looks(often, 0.2);
  EXPECT_FALSE(after(twice)) << "nobody came back";
  twice.add({placeAt(0), 8, false}, kObject, kOptions);
  EXPECT_FALSE(after(twice)) << "nobody was away for long enough";

  ExistenceLooks again = looks(often, 0.2);
  for (int i = 0; i < 3; ++i) again.add({placeAt(0.3 * i), 30.0 + i, i == 1}, kObject, kOptions);
  // (13.3), of all looks before each, of which ten count.
  const double seen1 = 10, seen2 = 10 * seen1 / 11, seen3 = 10 * (seen2 + 1) / 11;
  const auto p = [](double seen) { return (0.5 * 10 + seen) / (10 + 10); };
  ASSERT_TRUE(after(again));
  EXPECT_NEAR(
      *after(again),
      std::log((1 - p(seen1)) / 0.9) + std::log(p(seen2) / 0.1) + std::log((1 - p(seen3)) / 0.9),
      1e-9);

  // What is seen in two looks of five is there, although most looks miss it.
  ExistenceLooks seldom;
  for (int i = 0; i < 50; ++i)
    seldom.add({placeAt(0.2 * i), i + (i < 25 ? 0.0 : 30.0), i % 5 < 2}, kObject, kOptions);
  EXPECT_GT(after(seldom).value_or(-1), 0);

  ExistenceLooks doubtful = looks({true, false}, 0.2);
  doubtful.add({placeAt(0), 30, false}, kObject, kOptions);
  EXPECT_FALSE(after(doubtful)) << "it may never have been there";
  for (int i = 0; i < 10; ++i) doubtful.add({placeAt(0.2 * i), 31.0 + i, true}, kObject, kOptions);
  EXPECT_FALSE(after(doubtful)) << "nobody came back since it is known";
  doubtful.add({placeAt(0), 90, false}, kObject, kOptions);
  EXPECT_LT(after(doubtful).value_or(0), 0);
}

TEST(ExistenceLooks, TellWhatAReturnSaidLongAgo)
{
  ExistenceLooks walk = looks(std::vector<bool>(10, true), 0.2);
  for (int i = 0; i < 1000; ++i)
    walk.add({placeAt(0.2 * i), 30 + 0.1 * i, i % 4 == 0}, kObject, kOptions);
  EXPECT_GT(walk.afterReturn(kOptions.detectionProbability, kOptions).value_or(-1), 0);
}

TEST(ExistenceLooks, KnowTheSizeThatAThingIsSeenWith)
{
  ExistenceLooks seen;
  EXPECT_FALSE(seen.usualSize());
  seen.add({placeAt(0), 0, true, 40}, kObject, kOptions);
  seen.add({placeAt(1), 1, false}, kObject, kOptions);
  seen.add({placeAt(2), 2, true, 10}, kObject, kOptions);
  EXPECT_NEAR(seen.usualSize().value_or(0), 16, 1e-9);
}

TEST(ExistenceLooks, ForgottenVisitsLeaveWhatTheySaid)
{
  ExistenceLooks walk;
  for (int i = 0; i < 5000; ++i)
    walk.add(
        {
            {3, 0.5 * i, 0},
            0.1 * i, i % 4 != 0
    },
        {0, 0.5 * i, 0}, kOptions);
  EXPECT_NEAR(walk.independent(kOptions).seen, 3750, 1e-6);
  EXPECT_NEAR(walk.independent(kOptions).missed, 1250, 1e-6);
}

TEST(ExistenceLooks, KnowWhatAFileSaid)
{
  EXPECT_EQ(ExistenceLooks(4.5).logOdds(0.7, kOptions), 4.5);
  ExistenceLooks more(4.5);
  more.add({placeAt(0), 0, true}, kObject, kOptions);
  EXPECT_NEAR(more.logOdds(0.5, kOptions), 4.5 + std::log(5), 1e-12);
}

TEST(DetectionProbability, IsTheMeanOfPriorAndLooks)
{
  EXPECT_DOUBLE_EQ(detectionProbability({}, 0.5, kOptions), 0.5);
  EXPECT_DOUBLE_EQ(detectionProbability({30, 0}, 0.5, kOptions), 35.0 / 40);
  EXPECT_DOUBLE_EQ(
      detectionProbability({0, 1e6}, 0.5, kOptions), 2 * kOptions.falseAlarmProbability);
}
