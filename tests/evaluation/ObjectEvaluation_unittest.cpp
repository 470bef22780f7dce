#include "quadmap/evaluation/ObjectEvaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "../geometry/RandomGeometry.h"
#include "quadmap/geometry/Overlap.h"

using namespace quadmap;
using namespace quadmap::test;
using mrpt::poses::CPose3D;

namespace
{
ObjectRecord object(
    const std::string& id,
    const std::string& label,
    const CPose3D& T_world_obj,
    const Eigen::Vector3d& semiAxes = {0.2, 0.3, 0.4})
{
  ObjectRecord record;
  record.id = id;
  record.label = label;
  record.object = Ellipsoid(T_world_obj, semiAxes);
  return record;
}

ObjectRecord objectAt(const std::string& id, const std::string& label, double x, double y = 0)
{
  return object(id, label, CPose3D(x, y, 0, 0, 0, 0));
}

std::string pairsOf(const ObjectEvaluation& e)
{
  std::string text;
  for (const auto& m : e.matches) text += m.truth.id + m.estimated.id + " ";
  return text;
}
}  // namespace

TEST(CompareObjects, GivesDistanceAngleAndOverlapByHand)
{
  const auto truth = object("1", "box", CPose3D(1, 2, 3, 0, 0, 0), {0.5, 0.5, 0.5});
  const auto moved = object("2", "box", CPose3D(1.3, 2.4, 3, 0, 0, 0), {0.5, 0.5, 0.5});
  const auto c = compareObjects(truth, moved);
  EXPECT_NEAR(c.centerDistance, 0.5, 1e-12);
  ASSERT_TRUE(c.angle);
  EXPECT_NEAR(*c.angle, 0, 1e-12);
  EXPECT_NEAR(c.shapeIoU, 1, 1e-12) << "after the centres are aligned";
  EXPECT_NEAR(c.iou3d, 0.7 * 0.6 / (2 - 0.7 * 0.6), 1e-12) << "in place";
}

TEST(CompareObjects, RenamesTheAxesForAngleAndShape)
{
  // The same box described with x and y swapped, turned by 10 degrees.
  const double turn = 10 * M_PI / 180;
  const auto truth = object("1", "box", CPose3D(0, 0, 0, 0.3, 0, 0), {0.2, 0.6, 0.4});
  const auto other =
      object("2", "box", CPose3D(0, 0, 0, 0.3 + M_PI / 2 + turn, 0, 0), {0.6, 0.2, 0.4});
  const auto c = compareObjects(truth, other);
  ASSERT_TRUE(c.angle);
  EXPECT_NEAR(*c.angle, turn, 1e-12);
  EXPECT_NEAR(c.shapeIoU, 1, 1e-12);
}

TEST(CompareObjects, AlignsTheSameBoxUnderAllRelabelings)
{
  RandomGeometry random(71);
  const Eigen::Matrix3d cycle = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  const Eigen::Matrix3d quarter = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  const Eigen::Vector3d s(0.2, 0.5, 0.9);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 4; ++b)
    {
      Eigen::Matrix3d P = Eigen::Matrix3d::Identity();
      for (int i = 0; i < a; ++i) P = P * cycle;
      for (int i = 0; i < b; ++i) P = P * quarter;
      const Eigen::Matrix3d R = random.rotation();
      const auto truth = object("1", "box", poseOf(R, {1, 1, 1}), s);
      const auto same = object("2", "box", poseOf(R * P, {1, 1, 1}), P.transpose().cwiseAbs() * s);
      const auto c = compareObjects(truth, same);
      EXPECT_NEAR(*c.angle, 0, 1e-12);
      EXPECT_NEAR(c.shapeIoU, 1, 1e-12);
      EXPECT_NEAR(c.iou3d, 1, 1e-12);
    }
}

TEST(CompareObjects, HasNoAngleUnlessBothOrientationsAreDefined)
{
  for (const auto& [truthDefined, estimatedDefined] :
       {std::pair(false, true), std::pair(true, false), std::pair(false, false)})
  {
    auto truth = object("1", "cup", CPose3D(0, 0, 0, 0, 0, 0), {0.2, 0.3, 0.4});
    auto estimated = object("2", "cup", CPose3D(0, 0, 0, 0.7, 0, 0), {0.3, 0.2, 0.4});
    truth.orientationDefined = truthDefined;
    estimated.orientationDefined = estimatedDefined;
    const auto c = compareObjects(truth, estimated);
    EXPECT_FALSE(c.angle);
    EXPECT_NEAR(c.shapeIoU, 1, 1e-12)
        << "the better order of the horizontal axes, whatever the yaw";
  }
}

TEST(CompareObjects, KeepsTheVerticalWhenTheYawMeansNothing)
{
  // Wide and flat against narrow and tall: only horizontal axes may be exchanged.
  auto truth = object("1", "vase", CPose3D(), {0.1, 0.1, 0.4});
  auto lying = object("2", "vase", CPose3D(0, 0, 0, 0.5, 0, 0), {0.4, 0.1, 0.1});
  truth.orientationDefined = lying.orientationDefined = false;
  EXPECT_NEAR(compareObjects(truth, lying).shapeIoU, 1.0 / 7, 1e-12);

  // The truth's vertical may be another of its axes: in a world with y down, say.
  auto yDown = object("3", "vase", CPose3D(0, 0, 0, 0, 0, -M_PI / 2), {0.1, 0.4, 0.1});
  yDown.orientationDefined = false;
  EXPECT_NEAR(compareObjects(yDown, truth).shapeIoU, 1, 1e-12);
}

TEST(EvaluateObjects, MatchesOneToOneWithinTheLimit)
{
  const auto e = evaluateObjects(
      {objectAt("A", "chair", 0), objectAt("B", "chair", 1), objectAt("C", "chair", 5)},
      {objectAt("1", "chair", 0.1), objectAt("2", "chair", 0.2), objectAt("3", "chair", 1.29),
       objectAt("4", "chair", 5.31)},
      CPose3D());
  EXPECT_EQ(pairsOf(e), "A1 B3 ");
  ASSERT_EQ(e.missed.size(), 1u);
  EXPECT_EQ(e.missed[0].id, "C");
  ASSERT_EQ(e.spurious.size(), 2u);
  EXPECT_EQ(e.spurious[0].id, "2");
  EXPECT_EQ(e.spurious[1].id, "4");
  EXPECT_NEAR(*e.precision(), 2.0 / 4, 1e-12);
  EXPECT_NEAR(*e.recall(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(*e.f1(), 4.0 / 7, 1e-12);
  EXPECT_NEAR(*e.meanCenterDistance(), (0.1 + 0.29) / 2, 1e-12);
}

TEST(EvaluateObjects, PrefersMorePairsToNearerOnes)
{
  // Greedily B would take 1 (0.05 m) and leave A without partner; 1 can serve A, and 2 B.
  const auto e = evaluateObjects(
      {objectAt("A", "cup", 0), objectAt("B", "cup", 0.3)},
      {objectAt("1", "cup", 0.25), objectAt("2", "cup", 0.55)}, CPose3D());
  EXPECT_EQ(pairsOf(e), "A1 B2 ");
}

TEST(EvaluateObjects, AssignsAsBruteForceDoes)
{
  RandomGeometry random(72);
  for (int trial = 0; trial < 100; ++trial)
  {
    std::vector<ObjectRecord> truth, estimated;
    for (int i = 0; i < 5; ++i)
    {
      truth.push_back(objectAt(
          std::to_string(i), i < 3 ? "cup" : "bowl", random.uniform(0, 0.7),
          random.uniform(0, 0.7)));
      estimated.push_back(objectAt(
          std::to_string(i), i % 2 ? "cup" : "bowl", random.uniform(0, 0.7),
          random.uniform(0, 0.7)));
    }
    std::vector<std::size_t> order(5);
    std::iota(order.begin(), order.end(), 0);
    std::size_t mostPairs = 0;
    double leastSum = 1e9;
    do
    {
      std::size_t pairs = 0;
      double sum = 0;
      for (std::size_t i = 0; i < 5; ++i)
      {
        const double d = (truth[i].object.center() - estimated[order[i]].object.center()).norm();
        if (truth[i].label != estimated[order[i]].label || d > 0.3) continue;
        ++pairs;
        sum += d;
      }
      if (pairs > mostPairs || (pairs == mostPairs && sum < leastSum))
      {
        mostPairs = pairs;
        leastSum = sum;
      }
    } while (std::next_permutation(order.begin(), order.end()));

    const auto e = evaluateObjects(truth, estimated, CPose3D());
    ASSERT_EQ(e.matches.size(), mostPairs);
    double sum = 0;
    for (const auto& m : e.matches) sum += m.comparison.centerDistance;
    EXPECT_NEAR(sum, mostPairs == 0 ? 0.0 : leastSum, 1e-9);
  }
}

TEST(EvaluateObjects, ComparesLabelsUnderAllTheirSpellings)
{
  const auto matched = [](const std::string& a, const std::string& b)
  {
    return evaluateObjects({objectAt("1", a, 0)}, {objectAt("2", b, 0)}, CPose3D())
               .matches.size() == 1;
  };
  EXPECT_TRUE(matched("potted plant", "potted_plant"));
  EXPECT_TRUE(matched("Chair", "chair"));
  EXPECT_TRUE(matched("my own thing", "My_own_thing "));
  EXPECT_FALSE(matched("chair", "cup"));
  EXPECT_TRUE(matched("tv", "tvmonitor")) << "by the label table";
  EXPECT_TRUE(matched("dining table", "diningtable"));
  EXPECT_TRUE(matched("couch", "sofa"));
}

TEST(EvaluateObjects, DoesNotCountRarelySeenTruthAsMissed)
{
  auto rare = objectAt("A", "cup", 0), rareFound = objectAt("B", "cup", 2);
  auto often = objectAt("C", "cup", 4);
  rare.framesVisible = rareFound.framesVisible = 2;
  often.framesVisible = 3;
  const auto e = evaluateObjects({rare, rareFound, often}, {objectAt("1", "cup", 2)}, CPose3D());
  EXPECT_EQ(pairsOf(e), "B1 ");
  ASSERT_EQ(e.uncounted.size(), 1u);
  EXPECT_EQ(e.uncounted[0].id, "A");
  ASSERT_EQ(e.missed.size(), 1u);
  EXPECT_EQ(e.missed[0].id, "C");
  EXPECT_TRUE(e.spurious.empty()) << "what was found of the rarely seen is not false";
  EXPECT_NEAR(*e.recall(), 0.5, 1e-12);
  EXPECT_NEAR(*e.precision(), 1, 1e-12);
}

TEST(EvaluateObjects, CarriesTheEstimatesIntoTheTruthsWorld)
{
  RandomGeometry random(73);
  const CPose3D T_truth_estimated = random.pose(4);
  const auto estimated = object("1", "tv", random.pose(2));
  auto truth = estimated;
  truth.object = estimated.object.transformed(T_truth_estimated);
  const auto e = evaluateObjects({truth}, {estimated}, T_truth_estimated);
  ASSERT_EQ(e.matches.size(), 1u);
  EXPECT_NEAR(*e.meanCenterDistance(), 0, 1e-12);
  EXPECT_NEAR(*e.meanAngle(), 0, 1e-12);
  EXPECT_NEAR(*e.meanIoU3d(), 1, 1e-9);
  EXPECT_TRUE(evaluateObjects({truth}, {estimated}, CPose3D()).matches.empty());
}

TEST(EvaluateObjects, SaysHowTheErrorsCompareWithTheClaimedCovariances)
{
  // The estimate is 0.03 m off along its world's x, where it claims 0.01 m, and 0.02 m along its z,
  // which is up. In the truth's world up is anywhere.
  const CPose3D T_map_truth(1, 0, 0.5, 0.3, 0, 0);
  auto estimated = object("1", "tv", CPose3D(1.03, 0, 0.52, 0.3 + 0.04, 0, 0));
  RandomGeometry random(11);
  for (const CPose3D& T_truth_estimated :
       {CPose3D(0, 0, 0, M_PI / 2, 0, 0), CPose3D(0, 0, 0, 0, 0, M_PI / 2), random.pose(4)})
  {
    const auto truth = object("1", "tv", T_truth_estimated + T_map_truth);
    estimated.covariance.reset();
    EXPECT_FALSE(evaluateObjects({truth}, {estimated}, T_truth_estimated).meanCenterNees());
    estimated.covariance.emplace();
    estimated.covariance->setIdentity();
    estimated.covariance->diagonal().head<4>() << 1e-4, 1.0, 4e-4, 4e-4;
    const auto e = evaluateObjects({truth}, {estimated}, T_truth_estimated);
    ASSERT_EQ(e.matches.size(), 1u);
    EXPECT_NEAR(e.meanCenterNees().value(), 9 + 1, 1e-6);
    EXPECT_NEAR(e.meanHeightNees().value(), 1, 1e-6);
    EXPECT_NEAR(e.meanYawNees().value(), 4, 1e-6);
  }
}

TEST(EvaluateObjects, AveragesAnglesOverDefinedOrientationsOnly)
{
  auto cup = objectAt("A", "cup", 0);
  cup.orientationDefined = false;
  const auto chair = object("B", "chair", CPose3D(2, 0, 0, 0, 0, 0));
  const auto e = evaluateObjects(
      {cup, chair}, {objectAt("1", "cup", 0), object("2", "chair", CPose3D(2, 0, 0, 0.1, 0, 0))},
      CPose3D());
  ASSERT_EQ(e.matches.size(), 2u);
  EXPECT_NEAR(*e.meanAngle(), 0.1, 1e-12);
}

TEST(EvaluateObjects, HasNoFiguresForWhatDoesNotExist)
{
  const auto nothing = evaluateObjects({}, {}, CPose3D());
  EXPECT_FALSE(nothing.precision());
  EXPECT_FALSE(nothing.recall());
  EXPECT_FALSE(nothing.f1());
  EXPECT_FALSE(nothing.meanCenterDistance());
  EXPECT_FALSE(nothing.meanAngle());

  const auto noEstimate = evaluateObjects({objectAt("A", "cup", 0)}, {}, CPose3D());
  EXPECT_FALSE(noEstimate.precision());
  EXPECT_EQ(noEstimate.recall(), 0.0);
  EXPECT_EQ(noEstimate.f1(), 0.0);

  const auto noTruth = evaluateObjects({}, {objectAt("1", "cup", 0)}, CPose3D());
  EXPECT_EQ(noTruth.precision(), 0.0);
  EXPECT_FALSE(noTruth.recall());
  EXPECT_EQ(noTruth.spurious.size(), 1u);
}

TEST(EvaluateObjects, RefusesMoreThanItCanCompareInTime)
{
  const std::vector<ObjectRecord> many(1001, objectAt("A", "cup", 0));
  EXPECT_THROW(evaluateObjects(many, {}, CPose3D()), TooManyObjects);
  EXPECT_THROW(evaluateObjects({objectAt("A", "cup", 0)}, many, CPose3D()), std::runtime_error);
}
