#include "quadmap/quadric/QuadricObjects.h"

#include <gtest/gtest.h>

#include "../obs/InstalledLabels.h"
#include "BoxScene.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** Two chairs and a cup on the floor between them, watched from a circle. */
class QuadricObjectsTest : public ::testing::Test
{
 protected:
  const std::vector<std::pair<std::string, Ellipsoid>> world_ = {
      {"chair",   {CPose3D(0.5, 0.4, 0.45, 0.3, 0, 0), {0.26, 0.25, 0.45}}},
      {"chair", {CPose3D(-0.4, -0.3, 0.45, 0.9, 0, 0), {0.24, 0.25, 0.46}}},
      {  "cup",       {CPose3D(0.1, 0, 0.05, 0, 0, 0), {0.05, 0.05, 0.05}}}
  };
  std::vector<CPose3D> robots_;
  std::vector<std::map<std::size_t, ObjectId>> seen_;  // by keyframe, of the world's objects
  InsertionOptions options_;

  QuadricObjects::PoseOf poseOf() const
  {
    return [this](std::size_t k) { return robots_.at(k); };
  }

  /** One more keyframe with the boxes of all, in the order of the world. */
  void watch(QuadricObjects& objects, double angle, bool instances = false)
  {
    const std::size_t keyframe = robots_.size();
    robots_.push_back(robotOnCircle({0, 0, 0.4}, angle));
    std::vector<BoxView> views;
    for (const auto& [label, object] : world_)
    {
      views.push_back(viewOf(object, robots_.back(), keyframe));
      views.back().label = label;
      views.back().box = views.size() - 1;
      if (instances) views.back().instance = static_cast<std::uint32_t>(10 * views.size());
    }
    seen_.emplace_back();
    const Eigen::Matrix<double, 6, 6> exact = Eigen::Matrix<double, 6, 6>::Zero();
    for (const auto& decision : objects.add(views, {}, exact, poseOf()))
      if (decision.object) seen_.back()[decision.box] = *decision.object;
  }

  std::size_t started(const QuadricObjects& objects) const
  {
    std::size_t count = 0;
    for (const auto& [id, object] : objects.all()) count += object.waits ? 0 : 1;
    return count;
  }
};

}  // namespace

TEST_F(QuadricObjectsTest, BoxesOfOneThingBecomeOneObject)
{
  QuadricObjects objects(options_, labels());
  for (int i = 0; i < 20; ++i) watch(objects, 0.08 * i);
  ASSERT_EQ(objects.all().size(), world_.size()) << "no box was taken for something new";
  EXPECT_TRUE(objects.mergeOverlapping(poseOf()).empty());
  for (std::size_t i = 0; i < world_.size(); ++i)
  {
    ASSERT_EQ(seen_.back().count(i), 1u) << i;
    const QuadricObject& object = objects.all().at(seen_.back().at(i));
    EXPECT_EQ(object.views.size(), 20u) << i;
    for (const auto& view : object.views) EXPECT_EQ(view.box, i);
    const Ellipsoid& truth = world_[i].second;
    EXPECT_LT(
        (object.record.object.center() - truth.center()).norm(), 0.2 * truth.semiAxes().norm())
        << world_[i].first;
    const MapObject finished = objects.finished(object, poseOf());
    EXPECT_EQ(finished.label(), world_[i].first);
    EXPECT_EQ(finished.partialCount, 20u);
    EXPECT_GT(finished.existenceLogOdds, 3);
    EXPECT_NEAR(finished.object.rotation()(2, 2), 1, 1e-9) << "the map's objects stand upright";
  }
}

TEST_F(QuadricObjectsTest, WaitForViewsFromSeveralDirections)
{
  QuadricObjects objects(options_, labels());
  for (int i = 0; i < 60; ++i) watch(objects, 0);
  EXPECT_EQ(started(objects), 0u) << "one place tells no distance";
  EXPECT_EQ(objects.all().size(), world_.size()) << "but the tracks hold";
  watch(objects, 0.1);
  EXPECT_EQ(started(objects), 0u) << "6 degrees of 8";
  watch(objects, 0.2);
  EXPECT_EQ(started(objects), world_.size());
}

TEST_F(QuadricObjectsTest, AnotherRoundFindsTheSameObjects)
{
  QuadricObjects objects(options_, labels());
  for (int i = 0; i < 12; ++i) watch(objects, 0.1 * i);
  const auto before = seen_.back();
  objects.beginRound();
  robots_.clear();
  seen_.clear();
  for (int i = 0; i < 12; ++i) watch(objects, 0.1 * i);
  objects.endRound();
  EXPECT_EQ(seen_.front(), before) << "known from the first keyframe on";
  EXPECT_EQ(objects.all().size(), world_.size());
  for (const auto& [id, object] : objects.all()) EXPECT_EQ(object.record.partialCount, 12u);

  objects.beginRound();
  robots_.clear();
  for (int i = 0; i < 2; ++i) watch(objects, 0.1 * i);
  objects.endRound();
  EXPECT_TRUE(objects.all().empty()) << "two views are not enough";
}

TEST_F(QuadricObjectsTest, CovariancesOfALyingObjectGoWithItsAxes)
{
  QuadricObjects objects(options_, labels());
  for (int i = 0; i < 8; ++i) watch(objects, 0.1 * i);
  const ObjectId id = seen_.back().at(0);
  const Ellipsoid lying(CPose3D(1, 2, 3, 0.4, 1.5, 0.2), {0.2, 0.3, 0.9});  // x points down
  QuadricCovariance covariance = QuadricCovariance::Identity();
  covariance.diagonal().tail<3>() << 0.02, 0.03, 0.09;  // each a tenth of its axis
  covariance(6, 7) = covariance(7, 6) = 0.001;
  covariance(0, 8) = covariance(8, 0) = 0.002;
  objects.settle(id, lying, covariance);
  const MapObject finished = objects.finished(objects.all().at(id), poseOf());
  const Eigen::Vector3d axes = finished.object.semiAxes();
  EXPECT_NEAR(axes.z(), 0.2, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(finished.covariance(4 + i, 4 + i), 0.1 * axes[i], 1e-12);
  const int shorter = axes.x() < axes.y() ? 4 : 5, longer = 9 - shorter;
  EXPECT_NEAR(finished.covariance(6, shorter), 0.001, 1e-12);
  EXPECT_NEAR(finished.covariance(0, longer), 0.002, 1e-12);
  EXPECT_NEAR(finished.covariance(6, longer), 0, 1e-12);
}

TEST_F(QuadricObjectsTest, MergedObjectsWereSeenFromTheFirstToTheLastTime)
{
  QuadricObjects objects(options_, labels());
  const auto timeOf = [](std::size_t k) { return mrpt::Clock::fromDouble(1e9 + double(k)); };
  ObjectId ids[2] = {};
  for (std::size_t k = 0; k < 16; ++k)  // first one chair, then the other
  {
    robots_.push_back(robotOnCircle({0, 0, 0.4}, 0.1 * static_cast<double>(k)));
    const auto views = std::vector<BoxView>{viewOf(world_[k / 8].second, robots_.back(), k)};
    for (const auto& decision :
         objects.add(views, timeOf(k), Eigen::Matrix<double, 6, 6>::Zero(), poseOf()))
      if (decision.object) ids[k / 8] = *decision.object;
  }
  ASSERT_TRUE(ids[0] && ids[1] && ids[0] != ids[1]);
  objects.settle(
      ids[1], objects.all().at(ids[0]).record.object, objects.all().at(ids[0]).covariance);
  const auto merged = objects.mergeOverlapping(poseOf());
  ASSERT_EQ(merged.size(), 1u);
  const MapObject& kept = objects.all().at(merged[0].first).record;
  EXPECT_EQ(kept.firstSeen, timeOf(0));
  EXPECT_EQ(kept.lastSeen, timeOf(15));
  EXPECT_EQ(kept.partialCount, 16u);
}

TEST_F(QuadricObjectsTest, TakesGivenAssociations)
{
  options_.useInstanceIds = true;
  QuadricObjects objects(options_, labels());
  for (int i = 0; i < 8; ++i) watch(objects, 0.7 * i, true);  // too far apart to follow boxes
  ASSERT_EQ(objects.all().size(), world_.size());
  for (const auto& [id, object] : objects.all())
    for (const auto& view : object.views) EXPECT_EQ(view.instance, object.instance);
}

TEST_F(QuadricObjectsTest, KeepsFewTracks)
{
  options_.waiting.capacity = 2;
  QuadricObjects objects(options_, labels());
  watch(objects, 0);
  EXPECT_EQ(objects.all().size(), 2u);
}
