#include "Geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "SampleInventory.h"
#include "quadmap/geometry/ConvexHull.h"
#include "quadmap/rooms/RandomRoom.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
/** Upright cuboids near each other, of all sizes and headings. */
class RandomSolids
{
 public:
  InventoryItem next(const std::string& label)
  {
    const Eigen::Vector3d center(uniform(-0.6, 0.6), uniform(-0.6, 0.6), uniform(0.2, 0.8));
    const Eigen::Vector3d size(uniform(0.1, 0.9), uniform(0.1, 0.9), uniform(0.1, 0.9));
    return item(std::to_string(++id_), label, center, size, uniform(-3, 3));
  }
  double uniform(double from, double to)
  {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

 private:
  std::mt19937 random_{7};
  int id_ = 0;
};

/** A cuboid whose rotation is not computed anew for each point. */
class Solid
{
 public:
  explicit Solid(const Ellipsoid& cuboid) :
      r_(cuboid.rotation()), center_(cuboid.center()), s_(cuboid.semiAxes())
  {
  }

  const Eigen::Vector3d& center() const { return center_; }

  Eigen::Vector3d nearestPoint(const Eigen::Vector3d& p) const
  {
    const Eigen::Vector3d local = r_.transpose() * (p - center_);
    return center_ + r_ * local.cwiseMax(-s_).cwiseMin(s_);
  }

  bool holds(const Eigen::Vector3d& p) const { return (nearestPoint(p) - p).norm() < 1e-12; }

  /** Does the upright cuboid hold the point at another height? */
  bool isAboveOrBelow(const Eigen::Vector3d& p) const { return holds({p.x(), p.y(), center_.z()}); }

  /** A point by its place between -1 and 1 along each semi-axis. */
  Eigen::Vector3d at(const Eigen::Vector3d& place) const
  {
    return center_ + r_ * place.cwiseProduct(s_);
  }

 private:
  Eigen::Matrix3d r_;
  Eigen::Vector3d center_, s_;
};

/** The gap of two cuboids by going to and fro between their nearest points. */
double gapBySearch(const Solid& a, const Solid& b)
{
  Eigen::Vector3d p = a.center(), q = b.center();
  for (int i = 0; i < 3000; ++i)
  {
    q = b.nearestPoint(p);
    p = a.nearestPoint(q);
  }
  return (p - q).norm();
}

/** Share of the points of one cuboid that fulfil a condition, by sampling. */
template <typename F>
double shareOf(const Solid& solid, F&& condition, const Eigen::Array3i& steps = {20, 20, 20})
{
  int fulfilled = 0;
  for (int i = 0; i < steps.x(); ++i)
    for (int j = 0; j < steps.y(); ++j)
      for (int k = 0; k < steps.z(); ++k)
      {
        const Eigen::Array3d cell = Eigen::Array3d(i, j, k) + 0.5;
        if (condition(solid.at(cell * 2 / steps.cast<double>() - 1))) ++fulfilled;
      }
  return static_cast<double>(fulfilled) / steps.prod();
}

using Told = std::set<std::tuple<std::string, std::string, std::string>>;

/** All relations as (subject, relation, object), without those of fronts. */
Told toldOf(const Inventory& inventory)
{
  Told told;
  for (const Relation& relation : relationsOf(inventory))
    if (relation.kind != RelationKind::InFrontOf && relation.kind != RelationKind::Behind)
      told.emplace(relation.subject, textOf(relation.kind), relation.object);
  return told;
}
}  // namespace

TEST(RelationGeometry, GapIsTheSmallestDistanceOfTheCuboids)
{
  RandomSolids random;
  int apart = 0;
  for (int i = 0; i < 60; ++i)
  {
    const Inventory two = inventoryWith({random.next("box"), random.next("box")});
    const double expected =
        gapBySearch(Solid(two.items[0].record.object), Solid(two.items[1].record.object));
    const Geometry geometry(two);
    EXPECT_NEAR(geometry.gap(0, 1), expected, 1e-3) << i;
    EXPECT_DOUBLE_EQ(geometry.gap(0, 1), geometry.gap(1, 0));
    if (expected > 0.01) ++apart;
  }
  EXPECT_GT(apart, 10) << "the test says nothing of cuboids that do not overlap";
  EXPECT_LT(apart, 50);
}

TEST(RelationGeometry, FootprintsOverlapAsTheirPointsDo)
{
  RandomSolids random;
  for (int i = 0; i < 20; ++i)
  {
    const Ellipsoid a = random.next("box").record.object, b = random.next("box").record.object;
    const auto footprint = [](const Ellipsoid& object)
    {
      std::vector<Eigen::Vector2d> below;
      for (Eigen::Index c = 0; c < 8; ++c) below.push_back(object.cuboidCorners().col(c).head<2>());
      return convexHull(below);
    };
    const double area = areaOf(footprint(a));
    EXPECT_NEAR(area, 4 * a.semiAxes().x() * a.semiAxes().y(), 1e-9);
    const Solid below(b);
    const auto isOver = [&](const Eigen::Vector3d& p) { return below.isAboveOrBelow(p); };
    EXPECT_NEAR(
        sharedArea(footprint(a), footprint(b)) / area, shareOf(Solid(a), isOver, {60, 60, 1}), 0.03)
        << i;
  }
}

TEST(RelationGeometry, OnAndInAgreeWithSampledPoints)
{
  RandomSolids random;
  int on = 0, in = 0;
  for (int i = 0; i < 800; ++i)
  {
    InventoryItem below = random.next("desk"), above = random.next("box");
    // Near the top of the other one, so that some stand on it.
    const Eigen::Vector3d c = above.record.object.center();
    const Eigen::Vector3d s = 0.4 * above.record.object.semiAxes();
    const double top = below.record.object.center().z() + below.record.object.semiAxes().z();
    const double bottom = i % 2 == 0 ? top + random.uniform(-0.1, 0.1) : c.z() - s.z();
    above = item(
        above.record.id, "box", {0.6 * c.x(), 0.6 * c.y(), bottom + s.z()}, 2 * s,
        above.record.object.pose().yaw());
    const Ellipsoid &a = above.record.object, &b = below.record.object;
    const Solid one(a), other(b);
    const double over = shareOf(
        one, [&](const Eigen::Vector3d& p) { return other.isAboveOrBelow(p); }, {20, 20, 1});
    const double inside = shareOf(one, [&](const Eigen::Vector3d& p) { return other.holds(p); });
    const double tolerance = std::min(0.05, std::max(0.02, b.semiAxes().z() / 2));
    if (std::abs(over - 0.5) < 0.06 || std::abs(inside - 0.5) < 0.06) continue;

    const Geometry geometry(inventoryWith({above, below}));
    const bool isOn =
        over > 0.5 && std::abs(bottom - top) <= tolerance && a.center().z() > b.center().z();
    const bool isIn = inside > 0.5 && a.cuboidVolume() < b.cuboidVolume();
    EXPECT_EQ(geometry.on(0, 1).has_value(), isOn) << i;
    EXPECT_EQ(geometry.in(0, 1).has_value(), isIn) << i;
    on += isOn ? 1 : 0;
    in += isIn ? 1 : 0;
  }
  EXPECT_GT(on, 15);
  EXPECT_GT(in, 15);
}

TEST(RelationGeometry, TellsWhatAPersonWouldSayOfALivingRoom)
{
  const Told expected = {
      { "1",      "on",  "2"}, // the tv on its cabinet
      { "5",      "on",  "3"}, // a cup on the table
      { "6",      "on",  "3"}, // the bowl as well
      { "7",      "in",  "6"}, // and an apple in it
      { "9",      "on",  "4"}, // the teddy bear on the seat of the couch, not on its back
      { "9",      "in",  "4"}, // which is inside the cuboid, too
      {"10",      "in",  "3"}, // the suitcase under the table
      { "2", "next to", "11"}, // the plant beside the cabinet
      { "7",      "on",  "3"}, // which is on the table with its bowl
  };
  EXPECT_EQ(toldOf(livingRoom()), expected);
}

TEST(RelationGeometry, FrontsFaceTheMiddleOfTheMap)
{
  const Geometry room(livingRoom());
  const std::size_t tv = 0, table = 2, couch = 3, cupBehind = 7, plant = 10;
  ASSERT_TRUE(room.inFrontOf(couch, tv));
  EXPECT_NEAR(*room.inFrontOf(couch, tv), 2.95, 1e-9) << "from the face of the tv to the centre";
  EXPECT_TRUE(room.inFrontOf(table, tv));
  EXPECT_TRUE(room.behind(cupBehind, tv));
  EXPECT_FALSE(room.inFrontOf(cupBehind, tv));
  EXPECT_FALSE(room.inFrontOf(plant, tv)) << "it is beside it";
  EXPECT_TRUE(room.inFrontOf(table, couch)) << "which faces the other way";
  EXPECT_FALSE(room.behind(couch, tv));

  // The tv is turned by half a turn: its front is where it was.
  Inventory turned = livingRoom();
  turned.items[tv] = standing("1", "tv", {0.0, 2.0}, 0.50, {1.00, 0.10, 0.60}, M_PI);
  EXPECT_TRUE(Geometry(turned).inFrontOf(couch, tv));
}

TEST(RelationGeometry, OrderDecidesFrontsOfRoundAndSquareThings)
{
  // The middle is at the origin. The first thing is at x = 2, the second one before it.
  const auto inFront = [](InventoryItem thing, const Eigen::Vector2d& at)
  {
    const Inventory inventory = inventoryWith(
        {std::move(thing), standing("2", "cup", at, 0, {0.1, 0.1, 0.1}),
         standing("3", "cup", {0, 0}, 0, {0.1, 0.1, 0.1}),
         standing("4", "cup", {-9, 0.01}, 0, {0.1, 0.1, 0.1}),
         standing("5", "cup", {0, -0.01}, 0, {0.1, 0.1, 0.1})});
    return Geometry(inventory).inFrontOf(1, 0).has_value();
  };
  InventoryItem round = standing("1", "vase", {2, 0}, 0, {0.4, 0.3, 0.5}, 0.8);
  round.record.orientationDefined = false;
  EXPECT_TRUE(inFront(round, {1, 0}));
  EXPECT_FALSE(inFront(round, {3, 0}));
  // A square thing looks through the face that is nearest to the middle, a wide one never aside.
  EXPECT_TRUE(inFront(standing("1", "chair", {2, 0}, 0, {0.5, 0.5, 0.9}, M_PI / 2), {1, 0}));
  EXPECT_FALSE(inFront(standing("1", "couch", {2, 0}, 0, {2.0, 0.9, 0.8}, 0), {0.5, 0}));
  EXPECT_TRUE(inFront(standing("1", "couch", {2, 0}, 0, {2.0, 0.9, 0.8}, M_PI / 2), {0.5, 0}));
}

TEST(RelationGeometry, AChairFacesTheTableItStandsAt)
{
  const auto frontOfChair = [](const InventoryItem& chair, const InventoryItem& table)
  {
    return Geometry(inventoryWith(
                        {chair, table, standing("3", "cup", {0.01, 9}, 0, {0.1, 0.1, 0.1}),
                         standing("4", "cup", {-0.01, 9.5}, 0, {0.1, 0.1, 0.1})}))
        .frontOf(0);
  };
  const Eigen::Vector3d seat(0.5, 0.5, 0.9), top(2.4, 0.9, 0.75);
  const InventoryItem table = standing("2", "dining table", {0, 0}, 0, top);
  const auto at = [&](double x, double y) { return standing("1", "chair", {x, y}, 0, seat); };
  // Near the end of a long side the middle of the table is far aside.
  for (const double x : {-0.9, 0.0, 0.9})
  {
    EXPECT_TRUE(frontOfChair(at(x, 0.8), table).isApprox(Eigen::Vector2d(0, -1), 1e-9)) << x;
    EXPECT_TRUE(frontOfChair(at(x, 0.35), table).isApprox(Eigen::Vector2d(0, -1), 1e-9))
        << x << ", pushed under it";
  }
  EXPECT_TRUE(frontOfChair(at(1.5, 0.1), table).isApprox(Eigen::Vector2d(-1, 0), 1e-9));
  const Eigen::Vector2d away(0, 1);  // to the middle of the map
  EXPECT_TRUE(frontOfChair(at(0, 1.9), table).isApprox(away, 1e-9)) << "not at the table";
  InventoryItem phantom = table;
  phantom.record.existence = 0.3;
  EXPECT_TRUE(frontOfChair(at(0, 0.8), phantom).isApprox(away, 1e-9));
  EXPECT_TRUE(frontOfChair(at(0, 0.8), standing("2", "coffee table", {0, 0}, 0, {2.4, 0.9, 0.4}))
                  .isApprox(away, 1e-9))
      << "too low to sit at";
  EXPECT_TRUE(
      frontOfChair(standing("1", "suitcase", {0, 0.8}, 0, seat), table).isApprox(away, 1e-9));
}

TEST(RelationGeometry, MostChairsOfFurnishedRoomsFaceWhereTheyAreTakenToFace)
{
  int chairs = 0, right = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
  {
    std::vector<InventoryItem> items;
    std::vector<Eigen::Vector2d> truth;
    for (const auto& object : simulator::randomRoom(seed).objects)
    {
      if (object.label.empty() || !object.way.empty()) continue;
      items.push_back(item(std::to_string(items.size()), object.label, {0, 0, 0}, {1, 1, 1}));
      items.back().record.object = object.truth();
      items.back().record.orientationDefined = object.orientationDefined;
      truth.push_back(object.truth().rotation().col(0).head<2>());  // all furniture faces +x
    }
    const Inventory inventory = inventoryWith(items);
    const Geometry room(inventory);
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      if (items[i].record.label != "chair") continue;
      ++chairs;
      if (room.frontOf(i).dot(truth[i]) > std::cos(M_PI / 4)) ++right;
    }
  }
  EXPECT_GT(chairs, 20);
  EXPECT_GT(right, 0.7 * chairs) << "towards the middle alone: less than half";
}

TEST(RelationGeometry, BetweenMakesTheWayHardlyLonger)
{
  const Eigen::Vector3d small(0.1, 0.1, 0.1);
  const auto detour = [&](const Eigen::Vector2d& at)
  {
    return Geometry(
               inventoryWith(
                   {standing("1", "cup", at, 0, small), standing("2", "cup", {0, 0}, 0.7, small),
                    standing("3", "cup", {2, 0}, 0, small)}))
        .between(0, 1, 2);
  };
  ASSERT_TRUE(detour({1, 0}));
  EXPECT_NEAR(*detour({1, 0}), 0, 1e-9) << "heights play no part";
  EXPECT_TRUE(detour({1, 0.45})) << "2 * hypot(1, 0.45) = 2.193 m";
  EXPECT_FALSE(detour({1, 0.46})) << "2 * hypot(1, 0.46) = 2.202 m";
  EXPECT_FALSE(detour({-0.05, 0})) << "beyond the end";
  EXPECT_FALSE(detour({2.05, 0}));
}

TEST(RelationGeometry, SmallContainersHoldWhatIsInThem)
{
  const auto scene = [](double bottomOfApple)
  {
    return Geometry(inventoryWith(
        {standing("1", "apple", {0, 0}, bottomOfApple, {0.07, 0.07, 0.07}),
         standing("2", "bowl", {0, 0}, 0, {0.25, 0.25, 0.08})}));
  };
  EXPECT_TRUE(scene(0.01).in(0, 1));
  EXPECT_FALSE(scene(0.01).on(0, 1));
  EXPECT_FALSE(scene(0.08).in(0, 1));
  EXPECT_TRUE(scene(0.08).on(0, 1));
}

TEST(RelationGeometry, DoubtfulObjectsDoNotMoveTheMiddle)
{
  Inventory room = livingRoom();
  for (int i = 0; i < 30; ++i)
  {
    room.items.push_back(standing("x" + std::to_string(i), "cup", {0, 9}, 0, {0.1, 0.1, 0.1}));
    room.items.back().confirmed = false;
  }
  EXPECT_TRUE(Geometry(room).inFrontOf(3, 0)) << "thirty phantoms behind the tv";
}
