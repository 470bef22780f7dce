// Merging two maps of one place: random rooms, of which two maps err independently of each other,
// by what they claim.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../geometry/Algebra.h"
#include "../obs/TemporaryFolder.h"
#include "ObjectMapFixture.h"
#include "quadmap/maps/MapMerge.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kNewer = 1e5;  // [s] after the first map

/** A thing of the room, in the frame of the first map. */
MapObject thing(ObjectId id, const std::string& label, const CPose3D& pose)
{
  static const LabelTable labels = LabelTable::installed();
  MapObject object;
  object.id = id;
  object.object = Ellipsoid(pose, labels.properties(label).typicalSize / 2);
  object.labelCounts[label] = 20;
  object.completeCount = 20;
  object.existenceLogOdds = 6;
  object.orientationDefined = labels.properties(label).dominantDirection;
  object.firstSeen = mrpt::Clock::fromDouble(1.6e9);
  object.lastSeen = mrpt::Clock::fromDouble(1.6e9 + 60);
  return object;
}

using Room = std::vector<MapObject>;

/** A furnished room of 8 x 6 m, in which nothing overlaps. */
Room randomRoom(std::mt19937& rng)
{
  const std::vector<std::string> names = {"chair", "chair",        "chair", "dining table",
                                          "couch", "potted plant", "tv",    "bed",
                                          "cup",   "vase",         "book",  "refrigerator"};
  std::uniform_real_distribution<double> within(0.3, 1.7), yaw(-M_PI, M_PI);
  Room room;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const double x = -4 + 2.0 * static_cast<double>(i % 4) + within(rng);
    const double y = -3 + 2.0 * static_cast<double>(i / 4) + within(rng), angle = yaw(rng);
    room.push_back(thing(static_cast<ObjectId>(i + 1), names[i], CPose3D(x, y, 0.5, angle, 0, 0)));
  }
  return room;
}

/** A covariance with standard deviations of millimetres to centimetres, in any direction. */
UprightCovariance randomCovariance(std::mt19937& rng)
{
  std::uniform_real_distribution<double> sigma(0.004, 0.03);
  std::normal_distribution<double> any(0, 1);
  UprightCovariance A;
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = any(rng);
  const UprightCovariance Q = orthogonalOf(A);
  UprightState s;
  for (auto& value : s) value = sigma(rng);
  return Q * s.cwiseAbs2().asDiagonal() * Q.transpose();
}

/** A map of the room in a frame of its own, that errs as it claims.
 * \param firstId Other ids than in the room. */
CQuadricObjectMap mapOf(
    const Room& room, const CPose3D& T_room_map, std::mt19937& rng, double later = 0)
{
  std::normal_distribution<double> any(0, 1);
  CQuadricObjectMap map;
  Room shuffled = room;
  std::shuffle(shuffled.begin(), shuffled.end(), rng);
  for (const MapObject& truth : shuffled)
  {
    MapObject seen = truth;
    seen.covariance = randomCovariance(rng);
    UprightState noise;
    for (auto& value : noise) value = any(rng);
    const UprightState state =
        uprightStateOf(truth.object.transformed(-T_room_map)) + rootOf(seen.covariance) * noise;
    seen.object = ellipsoidOf(state);
    for (auto* time : {&seen.firstSeen, &seen.lastSeen})
      *time = mrpt::Clock::fromDouble(mrpt::Clock::toDouble(*time) + later);
    map.addObject(seen);
  }
  return map;
}

CQuadricObjectMap movedMap(const CQuadricObjectMap& map, const CPose3D& T_new_old)
{
  CQuadricObjectMap moved;
  for (const auto& [id, object] : map.objects())
  {
    MapObject there = object;
    there.object = object.object.transformed(T_new_old);
    UprightCovariance R = UprightCovariance::Identity();
    R.topLeftCorner<3, 3>() = T_new_old.getRotationMatrix().asEigen();
    there.covariance = R * object.covariance * R.transpose();
    moved.addObject(there);
  }
  return moved;
}

/** The object of a map that is the thing of the room, by its place. */
const MapObject* nearestTo(const CQuadricObjectMap& map, const Eigen::Vector3d& p)
{
  return map.nearest(pointOf(p));
}

struct Errors
{
  double own = 0, other = 0, merged = 0, nees = 0;
  int count = 0;
};

const CPose3D kOther(1.5, -0.7, 0.1, 2.1, 0, 0);  // T_own_other

std::size_t countOf(const MapMerge& merge, MapConflict kind)
{
  return static_cast<std::size_t>(std::count_if(
      merge.conflicts.begin(), merge.conflicts.end(),
      [&](const auto& conflict) { return conflict.kind == kind; }));
}

}  // namespace

TEST(MapMerging, KnowsMoreThanEitherMapAndAsMuchAsItClaims)
{
  std::mt19937 rng(1);
  Errors sum;
  double place = 0;
  MapMergeOptions independent;
  independent.errorCorrelation = 0;
  constexpr int kRooms = 40;
  for (int k = 0; k < kRooms; ++k)
  {
    const Room room = randomRoom(rng);
    CQuadricObjectMap own = mapOf(room, CPose3D(), rng);
    const CQuadricObjectMap before = own, other = mapOf(room, kOther, rng, kNewer);
    const auto merge = own.mergeMap(other, independent);
    ASSERT_TRUE(merge) << k;
    ASSERT_EQ(own.objects().size(), room.size()) << k << "\n" << own.asString();
    EXPECT_TRUE(merge->conflicts.empty()) << k;
    const CQuadricObjectMap otherHere = movedMap(other, kOther);
    for (const MapObject& truth : room)
    {
      const Eigen::Vector3d p = truth.object.center();
      const MapObject* merged = nearestTo(own, p);
      const Eigen::Vector3d error = merged->object.center() - p;
      sum.own += (nearestTo(before, p)->object.center() - p).norm();
      sum.other += (nearestTo(otherHere, p)->object.center() - p).norm();
      sum.merged += error.norm();
      sum.nees += squaredError(error, merged->covariance.topLeftCorner<3, 3>());
      ++sum.count;
    }
    Eigen::Vector4d off(
        merge->match.T_map_local.x() - kOther.x(), merge->match.T_map_local.y() - kOther.y(),
        merge->match.T_map_local.z() - kOther.z(), merge->match.T_map_local.yaw() - kOther.yaw());
    place += squaredError(off, merge->placeCovariance) / kRooms;
  }
  EXPECT_LT(sum.merged, 0.8 * std::min(sum.own, sum.other)) << "1 / sqrt(2) at best";
  EXPECT_NEAR(sum.nees / sum.count, 3, 0.5) << "squared error over claimed, of the centres";
  EXPECT_NEAR(place, 4, 1.5) << "of the other map's place";
}

TEST(MapMerging, EqualMapsThatErrAlikeKnowLittleMoreThanOne)
{
  std::mt19937 rng(10);
  const Room room = randomRoom(rng);
  CQuadricObjectMap alike = mapOf(room, CPose3D(), rng);
  const CQuadricObjectMap one = alike;
  MapMergeOptions options;
  options.errorCorrelation = 1;
  ASSERT_TRUE(alike.mergeMap(one, options));
  for (const auto& [id, object] : one.objects())
  {
    const auto spread = [](const MapObject& o)
    { return o.covariance.topLeftCorner<3, 3>().trace(); };
    EXPECT_GE(spread(*alike.find(id)), 0.99 * spread(object)) << object.label();
  }
}

TEST(MapMerging, OrderPlaysNoPart)
{
  std::mt19937 rng(2);
  const Room room = randomRoom(rng);
  Room partly = room;
  partly.erase(partly.begin() + 1);
  const CQuadricObjectMap a = mapOf(partly, CPose3D(), rng);
  partly = room;
  partly.pop_back();
  partly[4].object = partly[4].object.transformed(CPose3D(0.4, 0, 0, 0, 0, 0));  // moved
  const CQuadricObjectMap b = mapOf(partly, kOther, rng, kNewer);
  CQuadricObjectMap ab = a, ba = b;
  const auto ofA = ab.mergeMap(b), ofB = ba.mergeMap(a);
  ASSERT_TRUE(ofA && ofB);
  const CPose3D &T = ofA->match.T_map_local, &back = ofB->match.T_map_local;
  EXPECT_LT((T + back).norm(), 1e-6);
  EXPECT_LT(std::abs((T + back).yaw()), 1e-6);
  ASSERT_EQ(ab.objects().size(), ba.objects().size());
  ASSERT_EQ(ab.confirmedObjects().size(), ba.confirmedObjects().size());
  for (const auto& entry : ba.objects())
  {
    const Ellipsoid there = entry.second.object.transformed(T);
    const MapObject* here = nearestTo(ab, there.center());
    EXPECT_LT((here->object.center() - there.center()).norm(), 1e-6) << here->label();
    Eigen::Vector3d s = here->object.semiAxes(), t = there.semiAxes();
    std::sort(s.data(), s.data() + 2);
    std::sort(t.data(), t.data() + 2);
    EXPECT_LT((s - t).norm(), 1e-6) << here->label();
    EXPECT_EQ(here->observations(), entry.second.observations());
    EXPECT_EQ(here->lastSeen, entry.second.lastSeen);
  }
  for (const MapConflict kind :
       {MapConflict::Moved, MapConflict::Gone, MapConflict::New, MapConflict::OnlyOne})
    EXPECT_EQ(countOf(*ofA, kind), countOf(*ofB, kind)) << nameOf(kind);
}

TEST(MapMerging, TheFrameAndTheIdsAreThoseOfTheFirstMap)
{
  std::mt19937 rng(3);
  const Room room = randomRoom(rng);
  Room more = room;
  more.push_back(thing(20, "suitcase", CPose3D(4.6, 0, 0.3, 0.2, 0, 0)));
  CQuadricObjectMap own = mapOf(room, CPose3D(), rng);
  const CQuadricObjectMap before = own, other = mapOf(more, kOther, rng, kNewer);
  const auto merge = own.mergeMap(other);
  ASSERT_TRUE(merge);
  ASSERT_EQ(own.objects().size(), more.size());
  for (const auto& [id, object] : before.objects())
    EXPECT_LT((own.find(id)->object.center() - object.object.center()).norm(), 0.1);
  const MapObject* suitcase = own.withLabel("suitcase").front();
  EXPECT_EQ(before.find(suitcase->id), nullptr);
  EXPECT_LT((suitcase->object.center() - Eigen::Vector3d(4.6, 0, 0.3)).norm(), 0.15);
  ASSERT_EQ(merge->origins.size(), more.size());
  for (const auto& origin : merge->origins)
  {
    EXPECT_EQ(origin.own.has_value(), before.find(origin.id) != nullptr);
    ASSERT_TRUE(origin.other);
    EXPECT_EQ(other.find(*origin.other)->label(), own.find(origin.id)->label());
  }
}

TEST(MapMerging, TheErrorOfThePlaceIsSharedByWhatOnlyTheOtherMapHas)
{
  std::mt19937 rng(4);
  const Room room = randomRoom(rng);
  Room more = room;
  more.push_back(thing(20, "suitcase", CPose3D(30, 0, 0.3, 0.2, 0, 0)));  // a long lever
  CQuadricObjectMap own = mapOf(room, CPose3D(), rng);
  const CQuadricObjectMap other = mapOf(more, kOther, rng, kNewer);
  const auto merge = own.mergeMap(other);
  ASSERT_TRUE(merge);
  const MapObject &here = *own.withLabel("suitcase").front(),
                  &there = *other.withLabel("suitcase").front();
  const double lever = there.object.center().norm(), yaw = merge->placeCovariance(3, 3);
  const auto spread = [](const MapObject& o) { return o.covariance.topLeftCorner<3, 3>().trace(); };
  EXPECT_NEAR(spread(here) - spread(there), yaw * lever * lever, 0.3 * yaw * lever * lever);
  const Eigen::Matrix3d shared = own.sharedError(here.id).topLeftCorner<3, 3>();
  EXPECT_GE(shared.trace(), 0.7 * yaw * lever * lever);
}

TEST(MapMerging, WhatMovedALittleIsWhereTheNewerMapHasIt)
{
  std::mt19937 rng(5);
  const Room room = randomRoom(rng);
  Room later = room;
  UprightState nudged = uprightStateOf(room[1].object);
  nudged.head<2>() += Eigen::Vector2d(0.12, -0.12);
  later[1].object = ellipsoidOf(nudged);
  for (const bool otherIsNewer : {true, false})
  {
    CQuadricObjectMap own = mapOf(room, CPose3D(), rng, otherIsNewer ? 0 : kNewer);
    const CQuadricObjectMap other = mapOf(later, kOther, rng, otherIsNewer ? kNewer : 0);
    const auto merge = own.mergeMap(other);
    ASSERT_TRUE(merge);
    EXPECT_EQ(merge->otherIsNewer, otherIsNewer);
    EXPECT_EQ(own.objects().size(), room.size());
    ASSERT_EQ(countOf(*merge, MapConflict::Moved), 1u);
    const auto& conflict = merge->conflicts.front();
    EXPECT_EQ(conflict.label, "chair");
    EXPECT_NEAR(conflict.distance, 0.17, 0.08);
    const Eigen::Vector3d expected = (otherIsNewer ? later : room)[1].object.center();
    EXPECT_LT((own.find(conflict.origin.id)->object.center() - expected).norm(), 0.08);
  }
}

TEST(MapMerging, OfMapsThatEndTogetherThatOfMoreMeasurementsIsTheNewerOne)
{
  std::mt19937 rng(5);
  const Room room = randomRoom(rng);
  Room more = room;
  more[0].completeCount += 5;
  for (const bool otherHasMore : {true, false})
  {
    CQuadricObjectMap own = mapOf(otherHasMore ? room : more, CPose3D(), rng);
    const auto merge = own.mergeMap(mapOf(otherHasMore ? more : room, kOther, rng));
    ASSERT_TRUE(merge);
    EXPECT_EQ(merge->otherIsNewer, otherHasMore);
  }
}

TEST(MapMerging, OtherPlacesAreToldAndLeaveTheMapAsItWas)
{
  std::mt19937 rng(6);
  const CQuadricObjectMap elsewhere = mapOf(randomRoom(rng), kOther, rng, kNewer);
  CQuadricObjectMap own = mapOf(randomRoom(rng), CPose3D(), rng);
  const std::string before = own.asString();
  EXPECT_FALSE(own.mergeMap(elsewhere));
  EXPECT_FALSE(own.mergeMap(CQuadricObjectMap()));
  EXPECT_EQ(own.asString(), before);
  CQuadricObjectMap empty;
  EXPECT_FALSE(empty.mergeMap(own));
}

TEST(MapMerging, AMapWithItselfHasTheSameObjects)
{
  std::mt19937 rng(7);
  CQuadricObjectMap map = mapOf(randomRoom(rng), CPose3D(), rng);
  const CQuadricObjectMap before = map;
  const auto merge = map.mergeMap(before);
  ASSERT_TRUE(merge);
  EXPECT_LT(merge->match.T_map_local.norm(), 1e-9);
  EXPECT_TRUE(merge->conflicts.empty());
  ASSERT_EQ(map.objects().size(), before.objects().size());
  for (const auto& [id, object] : before.objects())
    EXPECT_LT((map.find(id)->object.center() - object.object.center()).norm(), 2e-3);
}

TEST(MapMerging, WhatNeitherMapIsSureOfIsNotReported)
{
  std::mt19937 rng(8);
  Room sure = randomRoom(rng);
  sure.push_back(thing(20, "suitcase", CPose3D(4.6, 0, 0.3, 0.2, 0, 0)));
  Room doubtful = sure;
  doubtful.back().existenceLogOdds = 0;  // both maps of one place make the same mistakes
  CQuadricObjectMap own = mapOf(doubtful, CPose3D(), rng);
  ASSERT_TRUE(own.withLabel("suitcase").empty());
  CQuadricObjectMap both = own;
  ASSERT_TRUE(both.mergeMap(mapOf(doubtful, kOther, rng, kNewer)));
  EXPECT_TRUE(both.withLabel("suitcase").empty());
  ASSERT_TRUE(own.mergeMap(mapOf(sure, kOther, rng, kNewer)));
  ASSERT_EQ(own.withLabel("suitcase").size(), 1u);
  EXPECT_EQ(own.objects().size(), sure.size());
  EXPECT_EQ(own.withLabel("suitcase").front()->existenceLogOdds, 6);
}

TEST(MapMerging, KeepsDoubtsOfBothMapsInEitherOrder)
{
  std::mt19937 rng(9);
  Room room = randomRoom(rng);
  room.push_back(thing(20, "suitcase", CPose3D(4.6, 0, 0.3, 0.2, 0, 0)));
  room.back().existenceLogOdds = 0;
  Room later = room;
  later.back().completeCount += 7;
  room.push_back(thing(21, "sink", CPose3D(-4.6, 0, 0.3, 0.2, 0, 0)));
  room.back().existenceLogOdds = 0;
  later.push_back(thing(22, "bed", CPose3D(0, 4.6, 0.3, 0.2, 0, 0)));
  later.back().existenceLogOdds = 0;
  CQuadricObjectMap ab = mapOf(room, CPose3D(), rng), ba = mapOf(later, kOther, rng, kNewer);
  const CQuadricObjectMap a = ab, b = ba;
  const unsigned newerCount = room[room.size() - 2].observations() + 7;
  ASSERT_TRUE(ab.mergeMap(b) && ba.mergeMap(a));
  for (const CQuadricObjectMap* map : {&ab, &ba})
  {
    EXPECT_EQ(map->objects().size(), room.size() + 1);
    std::map<std::string, unsigned> countOfDoubt;
    for (const auto& [id, object] : map->objects())
      if (!object.confirmed) countOfDoubt[object.label()] = object.observations();
    ASSERT_EQ(countOfDoubt.size(), 3u) << "suitcase, sink and bed";
    EXPECT_EQ(countOfDoubt.at("suitcase"), newerCount);
    EXPECT_TRUE(countOfDoubt.count("sink") == 1 && countOfDoubt.count("bed") == 1);
  }
}

TEST(MapMerging, WhatTheOtherMapDoubtsItsOwnOptionsDecide)
{
  std::mt19937 rng(10);
  const Room room = randomRoom(rng);
  Room later = room;
  later.push_back(thing(22, "sink", CPose3D(0, 4.6, 0.3, 0.2, 0, 0)));
  later.back().existenceLogOdds = 4;
  CQuadricObjectMap a = mapOf(room, CPose3D(), rng), strict;
  strict.insertionOptions.existence.confirmLogOdds = 7;
  const CQuadricObjectMap usual = mapOf(later, kOther, rng, kNewer);
  for (const auto& [id, object] : usual.objects()) strict.addObject(object);
  ASSERT_TRUE(usual.withLabel("sink").size() == 1 && strict.withLabel("sink").empty());
  CQuadricObjectMap both = a;
  ASSERT_TRUE(both.mergeMap(strict));
  EXPECT_TRUE(both.withLabel("sink").empty());
  ASSERT_TRUE(a.mergeMap(usual));
  EXPECT_EQ(a.withLabel("sink").size(), 1u);
}

TEST(MapMerging, AStoredResultIsTheSameAndCanBeExtended)
{
  std::mt19937 rng(9);
  const Room room = randomRoom(rng);
  CQuadricObjectMap own = mapOf(room, CPose3D(), rng);
  ASSERT_TRUE(own.mergeMap(mapOf(room, kOther, rng, kNewer)));
  const TemporaryFolder folder;
  own.saveToFile(folder.path("both.quadmap"));
  CQuadricObjectMap loaded;
  loaded.loadFromFile(folder.path("both.quadmap"));
  loaded.consolidate();
  ASSERT_EQ(loaded.objects().size(), own.objects().size());
  for (const auto& [id, object] : own.objects())
  {
    EXPECT_LT((loaded.find(id)->object.center() - object.object.center()).norm(), 1e-3);
    EXPECT_NEAR(loaded.find(id)->covariance(0, 0) / object.covariance(0, 0), 1, 0.1);
  }
}
