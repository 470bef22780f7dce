#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "EstimatorFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

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
