#include "quadmap/estimation/RepeatedErrors.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
const Eigen::Vector3d kCenter(1, 2, 0.5);

Eigen::Vector3d cameraAt(double angle, double range)
{
  return kCenter + range * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
}

/** A view from there with an upper edge, and a left one when asked for. */
BoxMeasurement viewFrom(double angle, double ownSigma, double shared, bool left = false)
{
  BoxMeasurement view;
  view.camera = cameraAt(angle, 2);
  view.center = kCenter;
  const double sigma = std::hypot(ownSigma, shared);
  view.edges.push_back({Eigen::Vector3d(0, 0, -1), sigma, shared, BoxSide::Upper});
  const Eigen::Vector3d ahead = (kCenter - view.camera).normalized();
  if (left)
    view.edges.push_back({ahead.cross(Eigen::Vector3d::UnitZ()), sigma, shared, BoxSide::Left});
  return view;
}
}  // namespace

TEST(ShareEdgeErrors, ManyViewsKnowASideAsWellAsTheBestEstimateFromErrorsInCommon)
{
  constexpr std::size_t n = 7;
  constexpr double own = 0.02, shared = 0.05;
  std::vector<BoxMeasurement> views;
  for (std::size_t i = 0; i < n; ++i)
    views.push_back(viewFrom(0.5 * static_cast<double>(i), own, shared));
  shareEdgeErrors(views);
  double information = 0;
  for (const auto& view : views) information += std::pow(view.edges[0].sigma, -2);

  Eigen::MatrixXd C = Eigen::MatrixXd::Constant(n, n, shared * shared);
  C.diagonal().array() += own * own;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  EXPECT_NEAR(information, ones.dot(C.inverse() * ones), 1e-9 * information);
  for (const auto& view : views)  // what is its own stays its own
    EXPECT_NEAR(
        std::pow(view.edges[0].sigma, 2) - std::pow(view.edges[0].shared, 2), own * own, 1e-12);
}

TEST(ShareEdgeErrors, OtherSidesAndLoneViewsStayWhatTheyAre)
{
  std::vector<BoxMeasurement> views{viewFrom(0, 0.02, 0.05, true), viewFrom(1, 0.02, 0.05)};
  const std::vector<BoxMeasurement> before = views;
  shareEdgeErrors(views);
  EXPECT_GT(views[0].edges[0].sigma, before[0].edges[0].sigma);
  EXPECT_DOUBLE_EQ(views[0].edges[1].sigma, before[0].edges[1].sigma);
  std::vector<BoxMeasurement> one{before[0]};
  shareEdgeErrors(one);
  EXPECT_DOUBLE_EQ(one[0].edges[0].sigma, before[0].edges[0].sigma);
  EXPECT_DOUBLE_EQ(one[0].edges[0].shared, before[0].edges[0].shared);
}

TEST(ShareEdgeErrors, TheFourEdgesOfOneBoxAreFourSidesAlsoFromAbove)
{
  for (const double pitch : {-60.0, 0.0, 30.0, 45.0, 60.0, 90.0})
  {
    const double a = pitch * M_PI / 180;
    const Eigen::Vector3d ahead(std::cos(a), 0, -std::sin(a)), right(0, -1, 0);
    const Eigen::Vector3d down = ahead.cross(right);
    BoxMeasurement view;
    view.center = kCenter;
    view.camera = kCenter - 2 * ahead;
    for (const Eigen::Vector3d& side :
         {right, Eigen::Vector3d(-right), down, Eigen::Vector3d(-down)})
    {
      const Eigen::Vector3d inward = (side + 0.1 * ahead).normalized();
      view.edges.push_back({inward, 0.05, 0.04, boxSide(inward, ahead)});
    }
    std::vector<BoxMeasurement> views{view};
    shareEdgeErrors(views);
    for (const auto& edge : views[0].edges) EXPECT_DOUBLE_EQ(edge.sigma, 0.05) << pitch;

    views.assign(3, view);
    shareEdgeErrors(views);
    const double expected = std::sqrt(0.05 * 0.05 + 2 * 0.04 * 0.04);
    for (const auto& edge : views[0].edges) EXPECT_NEAR(edge.sigma, expected, 1e-12) << pitch;
  }
}

TEST(ShareEdgeErrors, AViewOfLittleWeightAddsLittle)
{
  std::vector<BoxMeasurement> views{viewFrom(0, 0.02, 0.05), viewFrom(1, 0.02, 0.05)};
  views[1].weight = 0.01;
  const double alone = views[0].edges[0].sigma;
  shareEdgeErrors(views);
  EXPECT_NEAR(views[0].edges[0].sigma, alone, 0.01 * alone);
}

TEST(RepeatedShare, FallsWithTheAngleBetweenTheViewsAndStaysAboveThatOfAnyTwo)
{
  const EstimatorOptions options;
  const auto share = [&](double angle, double range)
  { return repeatedShare(cameraAt(0, 2), cameraAt(angle, range), kCenter, options); };
  EXPECT_DOUBLE_EQ(share(0, 2), options.repeatedThere);
  EXPECT_NEAR(
      share(options.repeatedAngle, 2),
      options.repeatedAnywhere + (options.repeatedThere - options.repeatedAnywhere) / std::exp(1),
      0.01);
  EXPECT_GT(share(0.1, 2), share(0.2, 2));
  EXPECT_NEAR(share(M_PI, 2), options.repeatedAnywhere, 0.01);
  // Nearer by a small part is as far as that angle aside.
  EXPECT_NEAR(share(0, 2.1), share(0.05, 2), 2e-3);
  EXPECT_DOUBLE_EQ(
      repeatedShare(cameraAt(0, 3), cameraAt(1, 2), kCenter, options),
      repeatedShare(cameraAt(1, 2), cameraAt(0, 3), kCenter, options));
}
