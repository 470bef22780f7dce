#include "quadmap/constellation/Doubles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../obs/InstalledLabels.h"
#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** Position of a robot that goes along x and back, one keyframe each half metre [m]. */
Eigen::Vector3d robotAt(std::size_t keyframe)
{
  constexpr std::size_t kLast = 40;
  return {0.5 * static_cast<double>(std::min(keyframe, kLast - keyframe)), 0, 0};
}

/** Each step of that robot errs by 5 cm and 1 degree about the place where it ends, times a factor.
 * The sum goes over the steps that both things have in common. */
class DriftOfItsSteps : public Drift
{
 public:
  explicit DriftOfItsSteps(double factor) : factor_(factor) {}

  Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const override
  {
    constexpr double kShift = 0.05, kTurn = 0.0173;  // [m], [rad]
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    const std::size_t last = std::min(a.again, b.again);
    for (std::size_t k = std::max(a.before, b.before) + 1; k <= last; ++k)
      sum += kShift * kShift * Eigen::Matrix3d::Identity() +
             kTurn * kTurn * crossMatrix(a.place - robotAt(k)) *
                 crossMatrix(b.place - robotAt(k)).transpose();
    return factor_ * factor_ * sum;
  }

 private:
  double factor_;
};

/** What that robot sees: when it sets out and again when it is back. */
class SeenTwice
{
 public:
  using Keyframes = std::set<std::size_t>;

  /** An object that some keyframes saw. */
  ObjectId add(const std::string& label, const Eigen::Vector3d& center, const Keyframes& by)
  {
    MapObject object;
    object.id = static_cast<ObjectId>(objects_.size());
    object.object =
        Ellipsoid(CPose3D(center.x(), center.y(), center.z(), 0, 0, 0), {0.08, 0.08, 0.3});
    object.covariance = 1e-4 * UprightCovariance::Identity();
    object.labelCounts[label] = 10;
    objects_.push_back(object);
    seenBy_.push_back(by);
    return object.id;
  }

  void addSighting(ObjectId id, std::size_t keyframe) { seenBy_.at(id).insert(keyframe); }

  std::optional<Doubles> doubles(
      double drift = 1, const std::function<bool()>& shouldStop = [] { return false; }) const
  {
    return findDoubles(
        sighted(), DriftOfItsSteps(drift), labels(), ConstellationOptions(), shouldStop);
  }

 private:
  std::vector<SightedObject> sighted() const
  {
    std::vector<SightedObject> sighted;
    for (const MapObject& object : objects_)
    {
      const Keyframes& by = seenBy_[object.id];
      const auto distance = [&](std::size_t k)
      { return (robotAt(k) - object.object.center()).norm(); };
      const auto nearest = std::min_element(
          by.begin(), by.end(),
          [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
      sighted.push_back({&object, by, *nearest});
    }
    return sighted;
  }

  std::deque<MapObject> objects_;  // an object's id is its index
  std::vector<Keyframes> seenBy_;
};

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
  ASSERT_TRUE(run.doubles(1, [&] { return ++asked < 0; }));
  EXPECT_GE(asked, 4);
  for (const int last : {1, asked})
  {
    int now = 0;
    EXPECT_FALSE(run.doubles(1, [&] { return ++now == last; })) << last;
    EXPECT_EQ(now, last) << "it goes on no further";
  }
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
