#include "quadmap/constellation/ConstellationMatch.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../obs/InstalledLabels.h"
#include "PlaceGuesses.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
using Room = std::vector<MapObject>;

MapObject objectAt(ObjectId id, const std::string& label, const CPose3D& pose, bool oriented = true)
{
  const Eigen::Vector3d size = labels().properties(label).typicalSize;
  MapObject object;
  object.id = id;
  object.object = Ellipsoid(pose, size / 2);
  object.covariance = UprightCovariance::Identity() * 0.02 * 0.02;
  object.labelCounts[label] = 10;
  object.completeCount = 10;
  object.orientationDefined = oriented;
  return object;
}

/** A furnished room of 8 x 6 m with things of several labels, some more than once. */
Room randomRoom(std::mt19937& rng)
{
  const std::vector<std::string> names = {"chair", "chair",        "chair", "dining table",
                                          "couch", "potted plant", "tv",    "bed",
                                          "cup",   "cup",          "vase",  "refrigerator"};
  std::uniform_real_distribution<double> x(-4, 4), y(-3, 3), yaw(-M_PI, M_PI);
  Room room;
  ObjectId id = 1;
  for (const auto& name : names)
  {
    const double px = x(rng), py = y(rng), angle = yaw(rng);
    const double z = labels().properties(name).typicalSize.z() / 2;
    room.push_back(objectAt(
        id++, name, CPose3D(px, py, z, angle, 0, 0), labels().properties(name).dominantDirection));
  }
  return room;
}

/** A hall of 12 x 9 m with so many chairs that all look alike, and three other things. */
Room hallOfChairs(int chairs, std::mt19937& rng)
{
  std::uniform_real_distribution<double> x(-6, 6), y(-4.5, 4.5), yaw(-M_PI, M_PI);
  Room hall;
  const auto add = [&](const std::string& label)
  {
    const double px = x(rng), py = y(rng), angle = yaw(rng);
    hall.push_back(objectAt(
        static_cast<ObjectId>(hall.size() + 1), label, CPose3D(px, py, 0.45, angle, 0, 0)));
  };
  for (int i = 0; i < chairs; ++i) add("chair");
  for (const auto* label : {"refrigerator", "couch", "tv"}) add(label);
  return hall;
}

/** The room as another run has it: in its own frame, with errors, and ids from 100 on. */
Room seenFrom(const CPose3D& T_map_local, const Room& room, double sigma, std::mt19937& rng)
{
  std::normal_distribution<double> error(0, 1);
  Room local;
  for (const MapObject& object : room)
  {
    MapObject seen = object;
    seen.id = 100 + object.id;
    UprightState state = uprightStateOf(object.object.transformed(-T_map_local));
    for (int i = 0; i < 3; ++i) state[i] += sigma * error(rng);
    state[3] += 0.5 * sigma * error(rng);
    for (int i = 4; i < 7; ++i) state[i] += sigma * error(rng);
    seen.object = ellipsoidOf(state);
    local.push_back(seen);
  }
  return local;
}

std::optional<ConstellationMatch> match(const Room& local, const Room& map)
{
  std::vector<const MapObject*> a, b;
  for (const auto& object : local) a.push_back(&object);
  for (const auto& object : map) b.push_back(&object);
  return matchConstellation(a, b, labels(), {});
}

CPose3D randomPlace(std::mt19937& rng)
{
  std::uniform_real_distribution<double> shift(-5, 5), yaw(-M_PI, M_PI);
  const double x = shift(rng), y = shift(rng), z = 0.1 * shift(rng), angle = yaw(rng);
  return {x, y, z, angle, 0, 0};
}

double angleBetween(const CPose3D& a, const CPose3D& b)
{
  return std::abs(std::remainder(a.yaw() - b.yaw(), 2 * M_PI));
}
}  // namespace

TEST(ConstellationMatch, FindsRandomRoomsFromNoisyObjects)
{
  constexpr double kSigma = 0.04;
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    std::mt19937 rng(seed);
    const Room room = randomRoom(rng);
    const CPose3D truth = randomPlace(rng);
    const auto found = match(seenFrom(truth, room, kSigma, rng), room);
    ASSERT_TRUE(found) << seed;
    // 12 objects spread over metres: the mean errs by sigma / sqrt(12), 4 sigma of that at the
    // room.
    const CPose3D error = -truth + found->T_map_local;
    EXPECT_LT(angleBetween(truth, found->T_map_local), mrpt::DEG2RAD(2.0)) << seed;
    EXPECT_LT((-found->T_map_local + truth).norm(), 0.2) << seed << error.asString();
    EXPECT_GE(found->pairs.size(), 10u) << seed;
    for (const auto& [local, known] : found->pairs)
    {
      const bool twins = room[local - 101].label() == room[known - 1].label();
      EXPECT_TRUE(local == 100 + known || twins) << seed << ": " << local << " is not " << known;
    }
  }
}

TEST(ConstellationMatch, NeedsOnlySomeOfTheObjectsAndNoneOfTheNewOnes)
{
  int found = 0;
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    std::mt19937 rng(1000 + seed);
    const Room room = randomRoom(rng);
    const CPose3D truth = randomPlace(rng);
    Room local = seenFrom(truth, room, 0.03, rng);
    std::shuffle(local.begin(), local.end(), rng);
    local.resize(6);
    Room others = seenFrom(randomPlace(rng), randomRoom(rng), 0.03, rng);  // moved or brought
    for (std::size_t i = 0; i < 3; ++i)
    {
      others[i].id += 100;
      local.push_back(others[i]);
    }
    const auto result = match(local, room);
    if (!result) continue;  // too common things to be sure
    ++found;
    EXPECT_LT(angleBetween(truth, result->T_map_local), mrpt::DEG2RAD(6.0)) << seed;
    EXPECT_LT((-result->T_map_local + truth).norm(), 0.6) << seed;
  }
  EXPECT_GE(found, 34);
}

TEST(ConstellationMatch, WhatTheOthersPutElsewhereIsNoPair)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    std::mt19937 rng(8000 + seed);
    const Room room = randomRoom(rng);
    Room now = room;
    now[4].object = now[4].object.transformed(CPose3D(0.2, -0.15, 0, 0, 0, 0));  // the couch
    const auto found = match(seenFrom(randomPlace(rng), now, 0.02, rng), room);
    ASSERT_TRUE(found) << seed;
    for (const auto& [local, known] : found->pairs) EXPECT_NE(local, 105u) << seed;
  }
}

TEST(ConstellationMatch, FewTruePairsAreLostToTheOthers)
{
  std::size_t kept = 0, all = 0;
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    std::mt19937 rng(9000 + seed);
    const Room room = randomRoom(rng);
    const auto found = match(seenFrom(randomPlace(rng), room, 0.03, rng), room);
    ASSERT_TRUE(found) << seed;
    all += room.size();
    kept += found->pairs.size();
  }
  EXPECT_GE(kept, 0.98 * static_cast<double>(all));
}

TEST(ConstellationMatch, WhatErrsMoreThanMostStaysAPair)
{
  std::size_t kept = 0, all = 0;
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    std::mt19937 rng(9100 + seed);
    const Room hall = hallOfChairs(37, rng);
    const CPose3D place = randomPlace(rng);
    Room local = seenFrom(place, hall, 0.01, rng);
    const Room poor = seenFrom(place, hall, 0.04, rng);  // seen from another side than before
    for (std::size_t i = 0; i < local.size(); i += 6) local[i] = poor[i];
    const auto found = match(local, hall);
    ASSERT_TRUE(found) << seed;
    all += hall.size();
    kept += found->pairs.size();
  }
  EXPECT_GE(kept, 0.98 * static_cast<double>(all));
}

TEST(ConstellationMatch, WrongLabelsOfSomeDoNotMatter)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    std::mt19937 rng(2000 + seed);
    const Room room = randomRoom(rng);
    const CPose3D truth = randomPlace(rng);
    Room local = seenFrom(truth, room, 0.03, rng);
    local[0].labelCounts = {
        {"tv", 10}
    };
    local[5].labelCounts = {
        {"oven", 10}
    };
    const auto found = match(local, room);
    ASSERT_TRUE(found) << seed;
    EXPECT_LT(angleBetween(truth, found->T_map_local), mrpt::DEG2RAD(3.0)) << seed;
    for (const auto& pair : found->pairs) EXPECT_NE(pair.first, 106u) << "an oven is no plant";
  }
}

TEST(ConstellationMatch, RefusesOtherRooms)
{
  for (unsigned seed = 0; seed < 150; ++seed)
  {
    std::mt19937 rng(3000 + seed);
    const Room map = randomRoom(rng), other = randomRoom(rng);
    EXPECT_FALSE(match(other, map)) << seed;
  }
}

TEST(ConstellationMatch, RefusesSymmetricRooms)
{
  // Two rows of four chairs: the same after half a turn.
  Room room;
  for (int i = 0; i < 4; ++i)
    for (int side : {-1, 1})
      room.push_back(objectAt(
          static_cast<ObjectId>(room.size() + 1), "chair",
          CPose3D(i - 1.5, side * 1.2, 0.45, side * M_PI / 2, 0, 0)));
  std::mt19937 rng(1);
  const CPose3D truth = randomPlace(rng);
  EXPECT_FALSE(match(seenFrom(truth, room, 0.02, rng), room));

  // One thing that is not symmetric tells.
  room.push_back(objectAt(20, "refrigerator", CPose3D(2.8, 0.4, 0.9, 0.2, 0, 0)));
  const auto found = match(seenFrom(truth, room, 0.02, rng), room);
  ASSERT_TRUE(found);
  EXPECT_LT((-found->T_map_local + truth).norm(), 0.15);
  EXPECT_EQ(found->pairs.size(), 9u);
}

TEST(ConstellationMatch, FindsAHallOfAlikeChairs)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    std::mt19937 rng(4000 + seed);
    const Room hall = hallOfChairs(30, rng);
    const CPose3D truth = randomPlace(rng);
    const auto found = match(seenFrom(truth, hall, 0.03, rng), hall);
    ASSERT_TRUE(found) << seed;
    EXPECT_LT(angleBetween(truth, found->T_map_local), mrpt::DEG2RAD(1.0)) << seed;
    EXPECT_LT((-found->T_map_local + truth).norm(), 0.1) << seed;
    EXPECT_GE(found->pairs.size(), 30u) << seed;
  }
}

TEST(ConstellationMatch, FindsAHallWhereOnlyChairsAreLeft)
{
  std::mt19937 rng(5000);
  const Room hall = hallOfChairs(40, rng);
  const CPose3D truth = randomPlace(rng);
  Room local = seenFrom(truth, hall, 0.03, rng);
  std::shuffle(local.begin(), local.end(), rng);
  local.erase(
      std::remove_if(
          local.begin(), local.end(), [](const MapObject& o) { return o.label() != "chair"; }),
      local.end());
  for (auto& chair : local) chair.orientationDefined = false;  // from distances alone
  const auto found = match(local, hall);
  ASSERT_TRUE(found);
  EXPECT_LT((-found->T_map_local + truth).norm(), 0.1);
}

TEST(ConstellationMatch, GuessesAreBoundedAndDistinctivePairsAreAmongThem)
{
  constexpr std::size_t kChairs = 80;
  std::mt19937 rng(6000);
  const Room hall = hallOfChairs(kChairs, rng);
  const CPose3D truth = randomPlace(rng);
  Room local = seenFrom(truth, hall, 0.01, rng);
  for (auto& object : local) object.orientationDefined = false;
  std::vector<const MapObject*> a, b;
  for (const auto& object : local) a.push_back(&object);
  for (const auto& object : hall) b.push_back(&object);
  Constellations both{a, b, std::vector<std::vector<std::size_t>>(a.size())};
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (areAlike(*a[i], *b[j], labels(), {})) both.alike[i].push_back(j);
  ASSERT_GE(both.alike[0].size(), kChairs);
  const auto hasTheTruth = [&](const std::vector<Place>& places)
  {
    const auto isTrue = [&](const Place& p)
    {
      const CPose3D place(p.t.x(), p.t.y(), p.t.z(), p.yaw, 0, 0);
      return (-place + truth).norm() < 0.1 && angleBetween(place, truth) < mrpt::DEG2RAD(2.0);
    };
    return std::any_of(places.begin(), places.end(), isTrue);
  };
  const auto all = guessPlaces(both, {});
  EXPECT_GT(all.size(), kMaxPairsOfPairs / 50);
  EXPECT_LE(all.size(), kMaxPairsOfPairs);
  EXPECT_TRUE(hasTheTruth(all));
  for (std::size_t i = 0; i < kChairs; ++i) both.alike[i].clear();
  EXPECT_TRUE(hasTheTruth(guessPlaces(both, {}))) << "three things that are unlike";
}

TEST(ConstellationMatch, OneObjectIsNotEnough)
{
  const Room room = {
      objectAt(1, "bed", CPose3D(1, 2, 0.3, 0.3, 0, 0)),
      objectAt(2, "couch", CPose3D(-2, 1, 0.4, 0, 0, 0))};
  EXPECT_FALSE(match({room[0]}, room));
  EXPECT_FALSE(match({}, room));
  EXPECT_FALSE(match(room, {}));
}
