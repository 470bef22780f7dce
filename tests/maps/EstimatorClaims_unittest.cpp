#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "../geometry/Algebra.h"
#include "EstimatorFixture.h"
#include "quadmap/estimation/ViewResiduals.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(ObjectEstimator, ClaimsWhatOneErrorOfAllDepthMoves)
{
  // All faces of views from one side and above move away from their cameras by one share.
  SyntheticCamera camera(17);
  auto views = viewsAround(camera, kCabinet, 60);
  views.resize(15);
  for (auto& view : views) view.edges.clear();
  constexpr double kShare = 1e-4;
  auto scaled = views;
  for (auto& view : scaled)
  {
    const ObjectView before = view;
    std::array<double, kFaces> fromCenter;
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      const Eigen::Vector3d n = before.faceNormal(f);
      const double ofFace = before.faceOffset(f) - n.dot(before.camera);
      fromCenter[f] = before.halfSizes[static_cast<Eigen::Index>(f / 2)] + kShare * ofFace;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      view.center +=
          0.5 * (fromCenter[2 * axis] - fromCenter[2 * axis + 1]) * before.faceNormal(2 * axis);
      view.halfSizes[static_cast<Eigen::Index>(axis)] =
          0.5 * (fromCenter[2 * axis] + fromCenter[2 * axis + 1]);
    }
  }
  EstimatorOptions options, exact;
  exact.depthScaleSigma = 0;
  options.huber = exact.huber = 1e6;  // the estimate moves linearly
  options.maxIterations = exact.maxIterations = 200;
  const UprightState start = uprightStateOf(kCabinet.object);
  const auto estimate = [&](const std::vector<ObjectView>& of, const EstimatorOptions& with)
  { return estimatorOf(of, with).estimate(start, boxy("suitcase"), with); };
  const auto here = estimate(views, options);
  const UprightState perShare = (estimate(scaled, options).state - here.state) / kShare;
  const UprightCovariance expected =
      std::pow(options.depthScaleSigma, 2) * perShare * perShare.transpose();
  const UprightCovariance found = here.covariance - estimate(views, exact).covariance;
  EXPECT_GT(perShare.head<3>().norm(), 0.5) << "[m]: seen from one side";
  EXPECT_LT((found - expected).norm(), 0.1 * expected.norm()) << found << "\n\n" << expected;
}

class ContradictedSide : public ::testing::TestWithParam<std::size_t>
{
};

TEST_P(ContradictedSide, IsClaimedToBeUncertain)
{
  const std::size_t side = GetParam();  // +x or -x
  SyntheticCamera camera(19);
  auto views = viewsAround(camera, kCabinet, 40);
  const UprightState truth = uprightStateOf(kCabinet.object);
  constexpr double kFarther = 0.08;  // [m], many sigmas, and yet of some weight
  const std::size_t contradicting = 10;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    ObjectView& view = views[i];
    view.center = kCabinet.object.center();
    view.halfSizes = kCabinet.object.semiAxes();
    view.yaw = truth[3];
    view.edges.clear();
    for (auto& face : view.faces) face = {FaceKind::Measured, 0.01};
    if (i >= contradicting) continue;
    view.faces[side].kind = FaceKind::AtLeast;
    view.center += 0.5 * kFarther * view.faceNormal(side);
    view.halfSizes.x() += 0.5 * kFarther;
  }
  const auto label = boxy("suitcase");
  const auto estimator = estimatorOf(views, {});
  const UprightState at = estimator.estimate(truth, label, {}).state;
  const UprightCovariance C = estimator.contradictions(at, label, {});
  const Eigen::Vector3d x = views[0].faceNormal(side);
  const double variance = x.dot(C.topLeftCorner<3, 3>() * x);
  // The side is as much farther as it is seen to be, with the share of the weights of the views
  // that see it so; the centre is half as far.
  double all = 0, beyond = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const double weight = viewWeight(views[i], at);
    const double gap = views[i].faceOffset(side) - x.dot(at.head<3>()) - std::exp(at[4]);
    all += weight;
    if (i < contradicting) beyond += weight * gap * gap;
  }
  EXPECT_GT(beyond / all, 0.1 * kFarther * kFarther);
  EXPECT_NEAR(variance, 0.25 * beyond / all, 1e-3 * variance);
  const Eigen::Vector3d y = views[0].faceNormal(2);
  EXPECT_NEAR(y.dot(C.topLeftCorner<3, 3>() * y), 0, 1e-12);
  EXPECT_NEAR(C(2, 2), 0, 1e-12);
  EXPECT_EQ(C(3, 3), 0);

  // The other side stays: its place is the centre less the half size.
  UprightState otherSide = UprightState::Zero();
  otherSide.head<3>() = x;
  otherSide[4] = -std::exp(at[4]);
  EXPECT_NEAR(otherSide.dot(C * otherSide), 0, 1e-12);
  EXPECT_TRUE(estimatorOf({views.begin() + contradicting, views.end()}, {})
                  .contradictions(at, label, {})
                  .isZero(0));
}

INSTANTIATE_TEST_SUITE_P(ObjectEstimator, ContradictedSide, ::testing::Values(0, 1));

namespace
{
/** Views that agree on all sides but the one along +x, which the image cuts in each of them. */
std::vector<ObjectView> cutViews(const TrueObject& truth, double seen)
{
  SyntheticCamera camera(23);
  auto views = viewsAround(camera, truth, 20);
  for (ObjectView& view : views)
  {
    view.center = truth.object.center();
    view.halfSizes = truth.object.semiAxes();
    view.yaw = uprightStateOf(truth.object)[3];
    view.edges.clear();
    for (auto& face : view.faces) face = {FaceKind::Measured, 0.01};
    const double less = 2 * truth.object.semiAxes().x() - seen;
    view.center -= 0.5 * less * view.faceNormal(0);
    view.halfSizes.x() -= 0.5 * less;
    view.faces[0].kind = FaceKind::AtLeast;
    view.isCutByImage[0] = true;
  }
  return views;
}

Eigen::Vector3d normalOfFirst(const UprightState& x) { return {std::cos(x[3]), std::sin(x[3]), 0}; }
}  // namespace

TEST(ObjectEstimator, ClaimsHowFarAnObjectMayReachBeyondTheImages)
{
  // The label says what sizes there are. Of these the ones are drawn that are larger than what
  // the images show.
  const auto label = boxy("suitcase");
  std::mt19937 random(3);
  std::normal_distribution<double> size(std::log(label.typicalSize.x()), label.sizeSpread);
  for (const double seen : {0.62, 0.9, 1.2})  // [m]
  {
    const auto estimator = estimatorOf(cutViews(kCabinet, seen), {});
    const UprightState at = estimator.estimate({}, label, {}).state;
    const double estimated = 2 * std::exp(at[4]);
    ASSERT_NEAR(estimated, seen, 0.03);
    double squares = 0;
    int count = 0;
    while (count < 20000)
    {
      const double drawn = size(random);
      if (drawn < std::log(estimated)) continue;
      squares += std::pow(drawn - std::log(estimated), 2);
      ++count;
    }
    const double end = estimated * std::sqrt(squares / count);  // [m], to first order
    const UprightCovariance P = estimator.openEnds(at, label, {});
    const Eigen::Vector3d n = normalOfFirst(at);
    EXPECT_NEAR(std::sqrt(n.dot(P.topLeftCorner<3, 3>() * n)), 0.5 * end, 0.02 * end) << seen;
    UprightState otherSide = UprightState::Zero();  // was measured
    otherSide.head<3>() = n;
    otherSide[4] = -std::exp(at[4]);
    EXPECT_NEAR(otherSide.dot(P * otherSide), 0, 1e-12);
  }
}

TEST(ObjectEstimator, ASizeBeyondAllBoundsIsTheLabelsAndAsUncertain)
{
  const auto label = boxy("suitcase");
  EstimatorOptions options;
  options.maxIterations = 200;  // the size is far from where the search starts
  const auto estimator = estimatorOf(cutViews(kCabinet, 0.2), options);
  const auto result = estimator.estimate({}, label, options);
  EXPECT_NEAR(2 * std::exp(result.state[4]), label.typicalSize.x(), 0.03);
  EXPECT_GT(std::sqrt(result.covariance(4, 4)), 0.9 * label.sizeSpread);
  EXPECT_TRUE(estimator.openEnds(result.state, label, {}).isZero(0));
}

TEST(ObjectEstimator, WhatAFileKnewHoldsItsOpenEnds)
{
  const auto label = boxy("suitcase");
  const auto views = cutViews(kCabinet, 0.9);
  const auto first = estimatorOf(views, {});
  const auto result = first.estimate({}, label, {});
  const UprightCovariance doubts = first.openEnds(result.state, label, {});
  auto second = ObjectEstimator::fromSummary(first.summary(result.state, label, {}, doubts));
  const Eigen::Vector3d n = normalOfFirst(result.state);
  const auto sigmaOf = [&](const ObjectEstimator& e)
  {
    const auto again = e.estimate(result.state, label, {});
    EXPECT_TRUE(e.openEnds(again.state, label, {}).isZero(0));
    return std::sqrt(n.dot(again.covariance.topLeftCorner<3, 3>() * n));
  };
  const double claimed = std::sqrt(n.dot(doubts.topLeftCorner<3, 3>() * n));
  EXPECT_GT(sigmaOf(second), 0.5 * claimed) << "the label alone knows something of the size";
  auto whole = views.front();
  whole.faces[0].kind = FaceKind::Measured;
  whole.isCutByImage[0] = false;
  second.add(whole, {});
  EXPECT_LT(sigmaOf(second), 0.1 * claimed);
}

TEST(ObjectEstimator, OneViewOfAnEndIsEnough)
{
  const auto label = boxy("suitcase");
  auto views = cutViews(kCabinet, 0.78);
  const auto claimOf = [&]
  {
    const auto estimator = estimatorOf(views, {});
    return estimator.openEnds(estimator.estimate({}, label, {}).state, label, {}).norm();
  };
  EXPECT_GT(claimOf(), 0.01);
  views[4].faces[0].kind = FaceKind::Measured;
  views[4].isCutByImage[0] = false;
  EXPECT_EQ(claimOf(), 0);
}

TEST(ObjectEstimator, ClaimsWhatViewsErrByTogether)
{
  // Views from all around whose sides err by one standard normal number for all views of a side,
  // which has a quarter of the variance, and by one each for itself.
  constexpr double kSigma = 0.02, kTogether = 0.25;  // [m], [-]
  constexpr int kTrials = 100;
  SyntheticCamera camera(11);
  const auto around = viewsAround(camera, kCabinet, 60);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const UprightState truth = uprightStateOf(kCabinet.object);
  EstimatorOptions independent;
  independent.repeatedThere = independent.repeatedAnywhere = 0;
  double nees = 0, neesOfIndependent = 0;
  for (int trial = 0; trial < kTrials; ++trial)
  {
    std::array<double, kFaces> together;
    for (double& e : together) e = std::sqrt(kTogether) * kSigma * normal(random);
    auto views = around;
    for (auto& view : views)
    {
      std::array<double, kFaces> error;
      for (std::size_t f = 0; f < kFaces; ++f)
      {
        error[f] = together[f] + std::sqrt(1 - kTogether) * kSigma * normal(random);
        view.faces[f] = {FaceKind::Measured, kSigma};
      }
      view.pose = {0, 0};
      view.yaw = truth[3];
      view.center = kCabinet.object.center();
      view.halfSizes = kCabinet.object.semiAxes();
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double plus = error[2 * axis], minus = error[2 * axis + 1];
        view.center += 0.5 * (plus - minus) * view.faceNormal(2 * axis);
        view.halfSizes[static_cast<Eigen::Index>(axis)] += 0.5 * (plus + minus);
      }
    }
    const auto neesWith = [&](const EstimatorOptions& options)
    {
      const auto e = estimatorOf(views, options).estimate(truth, boxy("suitcase"), options);
      const Eigen::Vector3d off = (e.state - truth).head<3>();
      return squaredError(off, e.covariance.topLeftCorner<3, 3>());
    };
    nees += neesWith({}) / kTrials;
    neesOfIndependent += neesWith(independent) / kTrials;
  }
  // 3 is expected, less because neighbours repeat no more here than any two views.
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 3.7);
  EXPECT_GT(neesOfIndependent, 20);
}

TEST(ObjectEstimator, ManyViewsFromOnePlaceKnowLittleMoreThanOne)
{
  SyntheticCamera camera(12);
  camera.disturbances = Disturbances{};
  ObjectView view = viewsAround(camera, kCabinet, 1).at(0);
  ASSERT_TRUE(view.complete);
  view.pose = {0, 0};
  for (auto& face : view.faces)
    if (face.kind != FaceKind::Support) face = {FaceKind::Measured, 0.02};
  EstimatorOptions options;
  options.depthScaleSigma = 0;  // a matter of all views, too
  const auto sigmaOf = [&](std::size_t count)
  {
    const auto e = estimatorOf(std::vector<ObjectView>(count, view), options);
    return std::sqrt(e.estimate({}, boxy("suitcase"), options).covariance(0, 0));
  };
  EXPECT_LT(sigmaOf(100), sigmaOf(3));
  EXPECT_GT(sigmaOf(100), 0.8 * sigmaOf(3)) << "0.17 if they were independent";

  // What the pose errs by is another matter: each image has a pose of its own.
  view.pose = {0.02, 0};
  EXPECT_LT(sigmaOf(100), 0.3 * sigmaOf(3));
}

TEST(ObjectEstimator, ManyBoxesThatAreAlikeTooWideDoNotOutweighRightCuboids)
{
  SyntheticCamera camera(6);
  camera.disturbances = Disturbances{};
  std::vector<ObjectView> views;
  for (int i = 0; i < 30; ++i)
  {
    const Eigen::Vector3d eye(
        -0.6, -0.6 + 0.04 * i, 0.9);  // from one side: its far end is not seen
    const auto T = SyntheticCamera::lookAt(eye, kCabinet.object.center());
    auto view =
        *viewOf(camera.observe(T, {kCabinet}).objects.at(0), T, boxy("suitcase"), {0.001, 0.001});
    const Eigen::Vector3d ahead = (view.center - view.camera).normalized();
    const double wider = 0.05 * view.halfSizes.mean() / (view.center - view.camera).norm();
    for (auto& edge : view.edges) edge.plane.n = (edge.plane.n + wider * ahead).normalized();
    views.push_back(view);
  }
  const auto widthError = [&](const EstimatorOptions& options)
  {
    const auto state = estimatorOf(views, options).estimate({}, boxy("suitcase"), options).state;
    return std::abs(std::exp(state[4]) - kCabinet.object.semiAxes().x());
  };
  EstimatorOptions independent;
  independent.edgeShapeShare = 0;
  EXPECT_LT(widthError({}), 0.7 * widthError(independent));
}

TEST(ObjectEstimator, HoweverManyBoxesThereAreTheyKnowAHeightNoBetterThanWhatTheyShare)
{
  SyntheticCamera camera(7);
  camera.disturbances = Disturbances{};
  camera.disturbances.partialProbability = 1;
  EstimatorOptions options;
  options.repeatedThere = options.repeatedAnywhere = 0;  // other errors that views repeat
  LabelProperties anySize = boxy("suitcase");
  anySize.sizeSpread = 10;
  const auto result =
      estimatorOf(viewsAround(camera, kCabinet, 60), options).estimate({}, anySize, options);
  // Half the height is half of how far two edges are apart, each of which errs by the share of s.
  const double share = options.edgeShapeShare * kCabinet.object.semiAxes().mean();
  const double least = share / std::sqrt(2.0) / kCabinet.object.semiAxes().z();
  EXPECT_GT(std::sqrt(result.covariance(6, 6)), 0.9 * least);
}
