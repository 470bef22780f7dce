#include "quadmap/constellation/Doubles.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "SeenTwice.h"

using namespace quadmap;

namespace
{
const SeenTwice::Keyframes kBefore = {0, 1, 2, 3}, kAgain = {36, 37, 38, 39};
const Eigen::Vector3d kDrifted(0.3, 0.6, 0.2);  // [m]

/** Four things beside the start of the way. */
std::vector<ObjectId> addFour(
    SeenTwice& run, const Eigen::Vector3d& at, const SeenTwice::Keyframes& by)
{
  return {
      run.add("chair", at + Eigen::Vector3d(1, 1, 0.3), by),
      run.add("chair", at + Eigen::Vector3d(1.8, 1.1, 0.3), by),
      run.add("potted plant", at + Eigen::Vector3d(1.2, -0.9, 0.3), by),
      run.add("trash can", at + Eigen::Vector3d(0.3, -1.2, 0.3), by)};
}

/** So many things that differ, at most four, seen before and again. */
void addUnlike(SeenTwice& run, std::size_t count)
{
  const std::pair<const char*, Eigen::Vector3d> things[] = {
      {       "chair",      {1, 1, 0.3}},
      {"potted plant", {1.2, -0.9, 0.3}},
      {   "trash can", {0.3, -1.2, 0.3}},
      {       "couch",  {1.8, 1.1, 0.3}}
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto& [label, place] = things[i];
    run.add(label, place, kBefore);
    run.add(label, place + kDrifted, kAgain);
  }
}

/** A row of bottles, 0.2 m from each other, and a row that was seen again.
 * \param from Where the latter begins along the former [bottles]. */
void addRow(SeenTwice& run, int before, int again, double from)
{
  const auto place = [](double number) -> Eigen::Vector3d {
    return {0.8 + 0.2 * number, 1.6, 0.3};
  };
  for (int i = 0; i < before; ++i) run.add("bottle", place(i), kBefore);
  for (int i = 0; i < again; ++i) run.add("bottle", place(i + from) + kDrifted, kAgain);
}

std::map<ObjectId, ObjectId> pairsOf(const Doubles& doubles)
{
  std::map<ObjectId, ObjectId> pairs;
  for (const auto& pair : doubles.pairs) pairs[pair.before] = pair.again;
  return pairs;
}

}  // namespace

TEST(Doubles, AreFoundWhereTheOdometryMayHaveDriftedThatFar)
{
  SeenTwice run;
  const auto before = addFour(run, {0, 0, 0}, kBefore), again = addFour(run, kDrifted, kAgain);
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  const auto pairs = pairsOf(*doubles);
  ASSERT_EQ(pairs.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(pairs.at(before[i]), again[i]);
  EXPECT_NEAR(doubles->distance, kDrifted.norm(), 1e-6);
}

TEST(Doubles, AreNotFoundBeyondTheDrift)
{
  SeenTwice run;
  addFour(run, {0, 0, 0}, kBefore);
  addFour(run, kDrifted, kAgain);
  EXPECT_TRUE(run.candidates(0.1).empty());
  EXPECT_FALSE(run.doubles(0.1));
}

// A heading that errs moves what is seen far away to the side, but hardly along the way.
TEST(Doubles, OfRoomsFurnishedAlikeAreFoundInTheDirectionOfTheDriftOnly)
{
  constexpr double kApart = 1.5;  // [m]
  SeenTwice sideways, along;
  for (SeenTwice* run : {&sideways, &along}) addFour(*run, {0, 0, 0}, kBefore);
  addFour(sideways, {0, kApart, 0}, kAgain);
  addFour(along, {kApart, 0, 0}, kAgain);
  EXPECT_TRUE(sideways.doubles());
  EXPECT_FALSE(along.doubles());
}

// Asked for each pair that the search may start with: with four things twice, four times at least.
TEST(Doubles, AreNotSearchedAfterAStop)
{
  SeenTwice run;
  addFour(run, {0, 0, 0}, kBefore);
  addFour(run, kDrifted, kAgain);
  int asked = 0;
  const auto candidates = run.candidates();
  ASSERT_TRUE(run.doublesAmong(candidates, 1, [&] { return ++asked < 0; }));
  EXPECT_GE(asked, 4);
  for (const int last : {1, asked})
  {
    int now = 0;
    EXPECT_FALSE(run.doublesAmong(candidates, 1, [&] { return ++now == last; })) << last;
    EXPECT_EQ(now, last) << "it goes on no further";
  }
}

TEST(Doubles, AreLookedForAmongTheCandidatesAlone)
{
  SeenTwice run;
  addFour(run, {0, 0, 0}, kBefore);
  addFour(run, kDrifted, kAgain);
  auto candidates = run.candidates();
  ASSERT_GE(candidates.size(), 4U);
  const DoublesCandidate left = candidates.front();
  candidates.erase(candidates.begin());
  const auto doubles = run.doublesAmong(candidates);
  ASSERT_TRUE(doubles);
  const auto pairs = pairsOf(*doubles);
  EXPECT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs.count(left.before->object->id), 0U);
  EXPECT_FALSE(run.doublesAmong(candidates, 0.1)) << "a smaller drift explains none of them";
}

TEST(Doubles, HaveAHundredCandidatesAtMost)
{
  SeenTwice run;
  addRow(run, 11, 11, 0);
  EXPECT_EQ(run.candidates(5).size(), 100U);
}

TEST(Doubles, AreNoThingsThatOneImageShows)
{
  SeenTwice run;
  const auto before = addFour(run, {0, 0, 0}, kBefore);
  addFour(run, kDrifted, kAgain);
  ASSERT_TRUE(run.doubles());
  for (const ObjectId id : before) run.addSighting(id, 36);
  EXPECT_FALSE(run.doubles());
}

TEST(Doubles, MayShareFewImages)
{
  SeenTwice run;
  SeenTwice::Keyframes twelve, otherTwelve;
  for (std::size_t k = 0; k < 12; ++k)
  {
    twelve.insert(k);
    otherTwelve.insert(29 + k);
  }
  const ObjectId before = addFour(run, {0, 0, 0}, twelve).front();
  const ObjectId again = addFour(run, kDrifted, otherTwelve).front();
  run.addSighting(before, 30);
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  const auto pairs = pairsOf(*doubles);
  EXPECT_EQ(pairs.size(), 4U);
  EXPECT_EQ(pairs.at(before), again);
}

TEST(Doubles, AreNotFoundWhereOneThingAloneIsTwice)
{
  SeenTwice run;
  addUnlike(run, 1);
  EXPECT_FALSE(run.doubles());
}

// The second place may be the first one, moved by half a metre along the row or by a whole one.
TEST(Doubles, AreNotFoundWhereTheyCouldBeOthersAsWell)
{
  SeenTwice run;
  for (int i = 0; i < 6; ++i) run.add("chair", {0.5 * i, 1, 0.3}, kBefore);
  for (int i = 0; i < 4; ++i) run.add("chair", {0.5 * i + 0.25, 1.1, 0.3}, kAgain);
  EXPECT_FALSE(run.doubles());
}

// Which of two bottles was seen again is open. The other four things correct the poses alike.
TEST(Doubles, AreFoundWhereOneOfFiveCouldBeItsNeighbour)
{
  SeenTwice run;
  addUnlike(run, 4);
  addRow(run, 2, 1, 0.5);
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  EXPECT_EQ(doubles->pairs.size(), 5U);
}

TEST(Doubles, AreNotFoundWhereFewerThanThreePairsAreCertain)
{
  for (const int bottlesBefore : {1, 2})
  {
    SeenTwice run;
    addUnlike(run, 2);
    addRow(run, bottlesBefore, 1, 0.5 * (bottlesBefore - 1));
    EXPECT_EQ(run.doubles().has_value(), bottlesBefore == 1) << bottlesBefore;
  }
}

// Three pairs are common to both ways to pair a row with itself. They must be more than half.
TEST(Doubles, AreFoundWhereMostPairsAreCertain)
{
  for (const int open : {1, 2, 3})
  {
    SeenTwice certain, uncertain;
    for (SeenTwice* run : {&certain, &uncertain}) addUnlike(*run, 3);
    addRow(certain, open, open, 0);
    addRow(uncertain, open + 1, open, 0.5);
    EXPECT_TRUE(certain.doubles()) << open;
    EXPECT_EQ(uncertain.doubles().has_value(), open < 3) << open;
  }
}

// A row of three may have drifted by 0.7 of its steps along itself, or by 0.3 the other way: then
// one bottle at either end has no partner. Three pairs of these five are most, but not of all six.
TEST(Doubles, AreNotFoundWhereMostPairsOfTheSmallerSetAloneAreCertain)
{
  SeenTwice run;
  addUnlike(run, 3);
  addRow(run, 3, 3, 0.7);
  EXPECT_FALSE(run.doubles());
}
