#include "quadmap/maps/ObjectEstimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "../geometry/Algebra.h"
#include "SyntheticScene.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/RotationDistance.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
const PoseNoise kNoise;

LabelProperties boxy(const std::string& name)
{
  LabelProperties p;
  p.name = name;
  p.shapeExponent = 1.0;
  p.typicalSize = {0.6, 0.6, 0.6};
  p.sizeSpread = 0.6;
  p.known = true;
  return p;
}

const TrueObject kCabinet = cuboid("suitcase", {1.5, 0.4, 0.28}, {0.78, 0.43, 0.56}, 0.3);

/** Seen from all around, 2 m away. */
std::vector<ObjectView> viewsAround(SyntheticCamera& camera, const TrueObject& truth, int count)
{
  std::vector<ObjectView> views;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * M_PI * i / count;
    const Eigen::Vector3d eye =
        truth.object.center() + Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 1.0);
    const auto T_map_sensor = SyntheticCamera::lookAt(eye, truth.object.center());
    const auto obs = camera.observe(T_map_sensor, {truth});
    for (const auto& d : obs.objects)
      if (auto v = viewOf(d, camera.disturbed(T_map_sensor), boxy(truth.label), kNoise))
        views.push_back(*v);
  }
  return views;
}

ObjectEstimator estimatorOf(const std::vector<ObjectView>& views, const EstimatorOptions& options)
{
  ObjectEstimator e;
  for (const auto& v : views) e.add(v, options);
  return e;
}

void expectNear(const UprightState& x, const Ellipsoid& truth, double meters, double degrees)
{
  const Ellipsoid estimated = ellipsoidOf(x);
  EXPECT_LT((estimated.center() - truth.center()).norm(), meters);
  const auto rotation = symmetricRotationDistance(truth.rotation(), estimated.rotation());
  EXPECT_LT(rotation.angle * 180 / M_PI, degrees);
}

double shapeIoU(const UprightState& x, const Ellipsoid& truth)
{
  const Eigen::Vector3d s = x.tail<3>().array().exp();
  return std::max(
      alignedIoU(s, truth.semiAxes()), alignedIoU({s.y(), s.x(), s.z()}, truth.semiAxes()));
}

}  // namespace

TEST(UprightState, RoundTripsThroughTheEllipsoid)
{
  UprightState x;
  x << 1, -2, 0.5, 2.5, std::log(0.3), std::log(0.2), std::log(0.9);
  EXPECT_LT((uprightStateOf(ellipsoidOf(x)) - x).norm(), 1e-12);
}

TEST(ViewResiduals, GradientIsThatOfTheCost)
{
  SyntheticCamera camera(3);
  camera.disturbances.partialProbability = 0.4;
  UprightState x;
  x << 1.45, 0.47, 0.25, 0.4, std::log(0.42), std::log(0.2), std::log(0.3);
  EstimatorOptions options;
  options.edgesOfComplete = true;
  for (const auto& view : viewsAround(camera, kCabinet, 12))
    for (const double q : {1.05, 1.5, 2.0})
    {
      const auto cost = [&](const UprightState& at)
      {
        NormalEquations eq;
        addViewResiduals(view, at, q, options, 0.7, eq);
        return eq.cost;
      };
      NormalEquations eq;
      addViewResiduals(view, x, q, options, 0.7, eq);
      for (Eigen::Index i = 0; i < 7; ++i)
      {
        UprightState step = UprightState::Zero();
        step[i] = 1e-6;
        const double numeric = (cost(x + step) - cost(x - step)) / 2e-6;
        EXPECT_NEAR(eq.g[i], numeric, 1e-4 * std::abs(numeric) + 1e-4)
            << "coordinate " << i << ", q " << q;
      }
    }
}

TEST(ObjectEstimator, RecoversACabinetFromJitteringPoses)
{
  SyntheticCamera camera(1);
  const auto e = estimatorOf(viewsAround(camera, kCabinet, 58), {});
  const auto result = e.estimate({}, boxy("suitcase"), {});
  // 58 views with 2 cm of noise each average to a few millimetres; h_2 of turned faces and loose
  // boxes leave a bias below a centimetre.
  expectNear(result.state, kCabinet.object, 0.015, 1.0);
  EXPECT_GT(shapeIoU(result.state, kCabinet.object), 0.93);
  EXPECT_TRUE(result.orientationDefined);
  EXPECT_LT(std::sqrt(result.covariance(0, 0)), 0.01);
}

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

TEST(ObjectEstimator, BadCuboidsDoNotWreckTheObject)
{
  SyntheticCamera camera(2);
  camera.disturbances.wreckProbability = 0.25;
  const auto e = estimatorOf(viewsAround(camera, kCabinet, 40), {});
  const auto result = e.estimate({}, boxy("suitcase"), {});
  expectNear(result.state, kCabinet.object, 0.025, 1.5);
  EXPECT_GT(shapeIoU(result.state, kCabinet.object), 0.88);
}

TEST(ObjectEstimator, BoxEdgesAloneFixASizeWhenThereIsParallax)
{
  SyntheticCamera camera(4);
  camera.disturbances.partialProbability = 1;
  camera.disturbances.boxSigma = 1;
  camera.disturbances.poseSigma = camera.disturbances.poseAngleSigma = 0.001;
  auto label = boxy("suitcase");
  label.shapeExponent = 1.0;
  const auto e = estimatorOf(viewsAround(camera, kCabinet, 30), {});
  const auto result = e.estimate({}, label, {});
  EXPECT_LT((result.state.head<3>() - kCabinet.object.center()).norm(), 0.04);
  EXPECT_GT(shapeIoU(result.state, kCabinet.object), 0.8);
}

TEST(ObjectEstimator, WhatIsSeenThroughAnObjectDoesNotMoveIt)
{
  // A plant before a wall, seen from one side: every seed is taken from the wall, 0.6 m behind;
  // only the boxes are right, as right as a weak detector's are.
  std::vector<double> errors;  // [m]
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    SyntheticCamera camera(seed);
    camera.disturbances.partialProbability = 1;
    camera.disturbances.boxSigma = 4;
    std::vector<ObjectView> views;
    for (auto& v : viewsAround(camera, kCabinet, 90))
      if ((kCabinet.object.center() - v.camera).x() > 1.8) views.push_back(v);
    ASSERT_GE(views.size(), 10u);
    for (auto& v : views) v.center += 0.6 * (v.center - v.camera).normalized();
    const auto result = estimatorOf(views, {}).estimate({}, boxy("suitcase"), {});
    errors.push_back((result.state.head<3>() - kCabinet.object.center()).norm());
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.15);
  EXPECT_LT(errors.back(), 0.2);
}

TEST(ObjectEstimator, OneWrongCuboidIsOutvotedByBoxes)
{
  // The chair before a plant was once measured in the plant's box.
  SyntheticCamera camera(4);
  camera.disturbances.partialProbability = 1;
  camera.disturbances.boxSigma = 4;
  auto views = viewsAround(camera, kCabinet, 12);
  camera.disturbances.partialProbability = 0;
  ObjectView wrong = viewsAround(camera, kCabinet, 1).at(0);
  ASSERT_TRUE(wrong.complete);
  wrong.center += Eigen::Vector3d(0.9, 0.9, 0);
  views.insert(views.begin() + 5, wrong);
  const auto result = estimatorOf(views, {}).estimate({}, boxy("suitcase"), {});
  EXPECT_LT((result.state.head<3>() - kCabinet.object.center()).norm(), 0.08);
}

TEST(ObjectEstimator, UnseenSidesAreLowerBounds)
{
  // Seen from one side only: the far faces were measured inside the object; they must not pull.
  SyntheticCamera camera(5);
  camera.disturbances = Disturbances{};
  camera.disturbances.poseSigma = camera.disturbances.poseAngleSigma = 0;
  std::vector<ObjectView> views;
  for (int i = 0; i < 10; ++i)
  {
    const Eigen::Vector3d eye(-0.6, -0.6 + 0.1 * i, 0.9);
    const auto T = SyntheticCamera::lookAt(eye, kCabinet.object.center());
    views.push_back(
        *viewOf(camera.observe(T, {kCabinet}).objects.at(0), T, boxy("suitcase"), kNoise));
  }
  const auto result = estimatorOf(views, {}).estimate({}, boxy("suitcase"), {});
  const Eigen::Vector3d direction = Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 0);
  double largest = 0;  // of what was seen along the viewing axis
  for (const auto& v : views)
    for (std::size_t f = 0; f < 4; ++f)
      if (v.faces[f].kind == FaceKind::AtLeast && v.faceNormal(f).dot(direction) > 0.9)
        largest = std::max(largest, v.faceOffset(f));
  const double far =
      direction.dot(result.state.head<3>()) + std::exp(std::max(result.state[4], result.state[5]));
  EXPECT_GT(far, largest - 0.02);
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

TEST(ObjectEstimator, FewLowerBoundsBehindTheObjectDoNotStretchIt)
{
  // Seen from one side; in every fourth view the wall behind was taken for the object's end.
  SyntheticCamera camera(5);
  camera.disturbances = Disturbances{};
  camera.disturbances.poseSigma = camera.disturbances.poseAngleSigma = 0;
  constexpr double kLeak = 0.25;  // [m]
  std::vector<ObjectView> views;
  for (int i = 0; i < 12; ++i)
  {
    const Eigen::Vector3d eye(-0.6, -0.6 + 0.1 * i, 0.9);
    const auto T = SyntheticCamera::lookAt(eye, kCabinet.object.center());
    auto view =
        *viewOf(camera.observe(T, {kCabinet}).objects.at(0), T, boxy("suitcase"), {0.001, 0.001});
    for (std::size_t f = 0; f < 4; ++f)
    {
      if (view.faces[f].kind != FaceKind::AtLeast) continue;
      // Its end moves to the truth, or behind it.
      const Eigen::Vector3d n = view.faceNormal(f),
                            n_obj = kCabinet.object.rotation().transpose() * n;
      const double truth =
          n.dot(kCabinet.object.center()) + n_obj.cwiseAbs().dot(kCabinet.object.semiAxes());
      const double out = truth + (i % 4 == 0 ? kLeak : 0) - view.faceOffset(f);
      view.center += 0.5 * out * n;
      view.halfSizes[static_cast<Eigen::Index>(f / 2)] += 0.5 * out;
    }
    views.push_back(view);
  }
  const auto result = estimatorOf(views, {}).estimate({}, boxy("suitcase"), {});
  expectNear(result.state, kCabinet.object, 0.02, 2.0);
  EXPECT_GT(shapeIoU(result.state, kCabinet.object), 0.9);
}

TEST(ObjectEstimator, KeepsViewsFromAllSidesWhenThereAreTooMany)
{
  SyntheticCamera camera(6);
  const auto views = viewsAround(camera, kCabinet, 80);
  EstimatorOptions few;
  few.maxMeasurements = 20;
  const auto all = estimatorOf(views, {}).estimate({}, boxy("suitcase"), {});
  const auto thinned = estimatorOf(views, few);
  EXPECT_EQ(thinned.views().size(), 20u);
  const auto some = thinned.estimate({}, boxy("suitcase"), few);
  // A quarter of the measurements: half the precision of all.
  const Eigen::Array<double, 7, 1> sigma = some.covariance.diagonal().array().sqrt();
  EXPECT_LT(((some.state - all.state).array().abs() / sigma).maxCoeff(), 3.0);
}

TEST(ObjectEstimator, StaysPutWhenTheSameMeasurementsComeAgainAndAgain)
{
  EstimatorOptions options;
  options.maxMeasurements = 40;
  std::vector<double> moves;  // the largest of the seven coordinates' [sigma]
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    SyntheticCamera camera(seed);
    const auto views = viewsAround(camera, kCabinet, 30);
    const auto once = estimatorOf(views, options).estimate({}, boxy("suitcase"), options);
    ObjectEstimator repeated;
    for (int lap = 0; lap < 10; ++lap)
      for (const auto& v : views) repeated.add(v, options);
    const auto state = repeated.estimate({}, boxy("suitcase"), options).state;
    const Eigen::Array<double, 7, 1> sigma = once.covariance.diagonal().array().sqrt();
    moves.push_back(((state - once.state).array().abs() / sigma).maxCoeff());
  }
  // Ten of the thirty measurements are there twice: that moves the mean by a part of its own
  // standard deviation, and ten laps move it no further than one.
  std::sort(moves.begin(), moves.end());
  EXPECT_LT(moves[moves.size() / 2], 1.0);
  EXPECT_LT(moves.back(), 2.0);
}

TEST(ObjectEstimator, SummaryContinuesWhereTheMeasurementsStopped)
{
  SyntheticCamera camera(8);
  const auto e = estimatorOf(viewsAround(camera, kCabinet, 20), {});
  const auto before = e.estimate({}, boxy("suitcase"), {});
  const auto loaded = ObjectEstimator::fromSummary(e.summary(before.state, boxy("suitcase"), {}));
  const auto after = loaded.estimate(before.state, boxy("suitcase"), {});
  EXPECT_LT((after.state - before.state).norm(), 1e-3);
  EXPECT_TRUE(after.orientationDefined);
  for (Eigen::Index i = 0; i < 4; ++i)  // what the views repeat is in it, too
    EXPECT_NEAR(std::sqrt(after.covariance(i, i) / before.covariance(i, i)), 1, 0.05) << i;
}

TEST(ObjectEstimator, AbsorbsAPriorWhoseAxesAreNamedDifferently)
{
  SyntheticCamera camera(9);
  const auto e = estimatorOf(viewsAround(camera, kCabinet, 20), {});
  const auto here = e.estimate({}, boxy("suitcase"), {});
  // The same object a quarter turn on: x and y swapped.
  UprightState there = here.state;
  there[3] += M_PI / 2;
  std::swap(there[4], there[5]);
  const auto again = e.estimate(there, boxy("suitcase"), {});
  auto other = ObjectEstimator::fromSummary(e.summary(again.state, boxy("suitcase"), {}));

  ObjectEstimator both = ObjectEstimator::fromSummary(e.summary(here.state, boxy("suitcase"), {}));
  both.absorb(other, here.state, again.state, {});
  const auto merged = both.estimate(here.state, boxy("suitcase"), {});
  EXPECT_LT((merged.state - here.state).norm(), 2e-3);
  EXPECT_NEAR(merged.covariance(4, 4) / here.covariance(4, 4), 0.5, 0.1) << "twice the evidence";
}

TEST(ObjectEstimator, AbsorbsNoMoreMeasurementsThanItKeeps)
{
  SyntheticCamera camera(9);
  EstimatorOptions options;
  options.maxMeasurements = 20;
  auto e = estimatorOf(viewsAround(camera, kCabinet, 20), options);
  const auto other = estimatorOf(viewsAround(camera, kCabinet, 15), options);
  const auto at = e.estimate({}, boxy("suitcase"), options).state;
  e.absorb(other, at, at, options);
  EXPECT_EQ(e.views().size(), 20u);
  EXPECT_LT((e.estimate(at, boxy("suitcase"), options).state - at).norm(), 0.05);
}

TEST(ObjectEstimator, RoundLabelsBecomeRound)
{
  SyntheticCamera camera(10);
  const TrueObject cup = cuboid("cup", {1, 0, 0.8}, {0.09, 0.09, 0.12}, 0);
  auto label = boxy("cup");
  label.dominantDirection = false;
  label.shapeExponent = 2;
  label.typicalSize = {0.09, 0.09, 0.1};
  const auto result = estimatorOf(viewsAround(camera, cup, 12), {}).estimate({}, label, {});
  EXPECT_FALSE(result.orientationDefined);
  EXPECT_NEAR(result.state[4], result.state[5], 0.1);
  EXPECT_LT((result.state.head<3>() - cup.object.center()).norm(), 0.02);
}

TEST(ObjectEstimator, APriorHoldsBeyondTheTurn)
{
  SyntheticCamera camera(12);
  const TrueObject cabinet = cuboid("suitcase", {1.5, 0.4, 0.28}, {0.78, 0.43, 0.56}, M_PI + 0.01);
  ObjectEstimator::Estimate known;
  known.state = uprightStateOf(cabinet.object);
  known.state[3] = M_PI - 0.001;
  known.orientationDefined = true;
  for (const int views : {1, 5, 20})
    for (const double information : {80.0, 800.0, 8000.0})  // of the yaw [1/rad^2]
    {
      known.covariance = 1e-4 * UprightCovariance::Identity();
      known.covariance(3, 3) = 1 / information;
      auto e = ObjectEstimator::fromEstimate(known, boxy("suitcase"), {});
      for (const auto& view : viewsAround(camera, cabinet, views)) e.add(view, {});
      UprightState start = known.state;
      start[3] = -M_PI + 0.005;  // the same heading, as a state that was stored and read has it
      const UprightState x = e.estimate(start, boxy("suitcase"), {}).state;
      EXPECT_LT((x.head<3>() - cabinet.object.center()).norm(), 0.03);
      EXPECT_LT(std::abs(std::remainder(x[3] - M_PI - 0.01, 2 * M_PI)), 0.05)
          << views << " views, information " << information;
    }
}

TEST(MedianState, DoesNotDependOnWhereTheMapsOriginIs)
{
  SyntheticCamera camera(11);
  auto views = viewsAround(camera, kCabinet, 21);
  // A third has a wrong yaw, as it happens where only one side is seen.
  for (std::size_t k = 0; k < views.size(); k += 3) views[k].yaw += k % 2 ? 0.35 : -0.35;
  const std::deque<ObjectView> here(views.begin(), views.end());
  auto far = here;
  const Eigen::Vector3d shift(30, -40, 0.5);
  for (auto& view : far) view.center += shift;
  const auto state = medianState(here, boxy("suitcase"));
  auto moved = medianState(far, boxy("suitcase"));
  ASSERT_TRUE(state && moved);
  moved->head<3>() -= shift;
  EXPECT_LT((*moved - *state).cwiseAbs().maxCoeff(), 1e-9);
  expectNear(*state, kCabinet.object, 0.03, 8.0);
}

TEST(ObjectEstimator, NothingToEstimateIsAnError)
{
  EXPECT_THROW(ObjectEstimator().estimate({}, boxy("x"), {}), std::logic_error);
  EXPECT_FALSE(medianState({}, boxy("x")));
}

TEST(ObjectView, UnusableMeasurementsGiveNone)
{
  DetectedObject d;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise)) << "kind None";
  d.measurement.kind = MeasurementKind::Rejected;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise));
  d.measurement.kind = MeasurementKind::Partial;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise)) << "neither seed nor edges";
}

TEST(ObjectView, LeaningCuboidsAreNotUsedAsCuboids)
{
  DetectedObject d;
  d.measurement.kind = MeasurementKind::Complete;
  CompleteMeasurement c;
  c.object_sensor = Ellipsoid(mrpt::poses::CPose3D(2, 0, 0, 0, 0.6, 0), {0.2, 0.2, 0.2});
  d.measurement.complete = c;
  d.measurement.seed_sensor = Eigen::Vector3d(1.8, 0, 0);
  const auto view = viewOf(d, {}, boxy("x"), kNoise);
  ASSERT_TRUE(view);
  EXPECT_FALSE(view->complete);
}

TEST(ObjectView, WithoutDepthAThingIsOnTheRayOfItsBoxAsFarAsItsSizeSays)
{
  PinholeCamera camera;
  camera.fx = camera.fy = 525;
  camera.cx = 320;
  camera.cy = 240;
  camera.width = 640;
  camera.height = 480;
  LabelProperties label = boxy("thing");
  label.known = true;
  label.typicalSize = {0.4, 0.4, 0.5};
  label.sizeSpread = 0.3;
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(3.5, 1.5, 8), Eigen::Vector3d(-1, -0.8, 2.5)})
  {
    const Ellipsoid thing({center.x(), center.y(), center.z(), 0, 0, 0}, {0.2, 0.25, 0.2});
    const auto box = projectEllipsoidBox(camera, thing);
    ASSERT_TRUE(box);
    DetectedObject d;
    d.measurement.kind = MeasurementKind::Partial;
    d.measurement.edges.emplace();
    const auto planes = boxEdgePlanes(camera, *box);
    for (std::size_t e = 0; e < 4; ++e)
      (*d.measurement.edges)[e].plane_sensor = planes[e].transformed(T_sensor_optical());
    const auto view = viewOf(d, {}, label, kNoise);
    ASSERT_TRUE(view);
    const Eigen::Vector3d p_optical(-view->center.y(), -view->center.z(), view->center.x());
    EXPECT_LT((p_optical.normalized() - center.normalized()).norm(), 0.003) << center.transpose();
    EXPECT_NEAR(p_optical.norm(), center.norm(), 0.05 * center.norm());
    const Eigen::Vector3d along = view->center.normalized();
    EXPECT_NEAR(
        std::sqrt(along.dot(view->centerCovariance * along)) / view->center.norm(), 0.36, 0.02);

    label.known = false;
    EXPECT_GT((viewOf(d, {}, label, kNoise)->center).norm(), 1.0) << "no size, no range";
    label.known = true;
  }
}
