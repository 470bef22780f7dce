#include "relocalization/KnownObjects.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kSmall = 1e-7;  // a mapSigma that adds nothing one could see [m]

struct Pair
{
  MapObject here, there;
};

UprightState stateOf(const ObjectPrior& prior)
{
  return Eigen::Map<const UprightState>(prior.at.data());
}

UprightCovariance covarianceOf(const ObjectPrior& prior) { return prior.L.inverse(); }

UprightCovariance someCovariance()
{
  Eigen::Matrix<double, 7, 7> root;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) root(i, j) = 0.01 * std::sin(3.0 * i + 1.7 * j + 0.4 * i * j);
  return root * root.transpose() + 1e-4 * UprightCovariance::Identity();
}

MapObject boxAt(double yaw, double a, double b)
{
  MapObject object;
  object.object = Ellipsoid(CPose3D(1.0, -2.0, 0.3, yaw, 0, 0), {a, b, 0.3});
  object.covariance = someCovariance();
  return object;
}

/** What a state says whatever its axes are called: place, yaw, and ln of how far its ellipsoid
 * reaches along two fixed horizontal directions and upwards. */
UprightState nameless(const UprightState& state, double direction)
{
  const Ellipsoid object = ellipsoidOf(state);
  UprightState says = state;
  for (int i = 0; i < 3; ++i)
  {
    const double angle = direction + i * M_PI / 2;
    Eigen::Vector3d u(std::cos(angle), std::sin(angle), 0);
    if (i == 2) u = Eigen::Vector3d::UnitZ();
    says[4 + i] =
        std::log((object.semiAxes().asDiagonal() * object.rotation().transpose() * u).norm());
  }
  return says;
}

/** Covariance of nameless(), by central differences. */
UprightCovariance namelessCovariance(
    const UprightState& state, const UprightCovariance& covariance, double direction)
{
  UprightCovariance J;
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 7; ++i)
  {
    const UprightState d = kStep * UprightState::Unit(i);
    J.col(i) = (nameless(state + d, direction) - nameless(state - d, direction)) / (2 * kStep);
  }
  return J * covariance * J.transpose();
}
}  // namespace

TEST(KnownObjects, AreTheSameCuboidsNamedAsInTheRun)
{
  for (int quarters = 0; quarters < 4; ++quarters)
  {
    const bool odd = quarters % 2 == 1;
    const double yaw = 0.4, turned = yaw + 0.1 + quarters * M_PI / 2;
    const Pair pair{
        odd ? boxAt(turned, 0.2, 0.35) : boxAt(turned, 0.35, 0.2), boxAt(yaw, 0.35, 0.2)};
    const ObjectPrior prior = priorOf(pair.here, pair.there, kSmall);
    const UprightState state = stateOf(prior), here = uprightStateOf(pair.here.object);
    EXPECT_NEAR(state[3], here[3] - 0.1, 1e-9) << quarters << ": not a turn away";
    EXPECT_LT((state.tail<3>() - here.tail<3>()).norm(), 1e-9) << quarters;
    EXPECT_LT((ellipsoidOf(state).dualQuadric() - pair.there.object.dualQuadric()).norm(), 1e-9)
        << quarters;
    const UprightCovariance expected =
        namelessCovariance(uprightStateOf(pair.there.object), pair.there.covariance, yaw);
    EXPECT_LT((namelessCovariance(state, covarianceOf(prior), yaw) - expected).norm(), 1e-8)
        << quarters << ": of numbers of about 1e-4";
  }
}

TEST(KnownObjects, WithoutAHeadingAreNamedByTheirSides)
{
  const Pair pairs[] = {
      {boxAt(0.4, 0.35,  0.2), boxAt(0.4 + M_PI / 2, 0.36, 0.21)},
      {boxAt(0.4, 0.35,  0.2),            boxAt(0.4, 0.21, 0.36)},
      {boxAt(0.4,  0.2, 0.35),            boxAt(1.0, 0.36, 0.21)}
  };
  for (const Pair& defined : pairs)
    for (const bool isHere : {false, true})
    {
      Pair pair = defined;
      (isHere ? pair.here : pair.there).orientationDefined = false;
      const ObjectPrior prior = priorOf(pair.here, pair.there, kSmall);
      const UprightState state = stateOf(prior), here = uprightStateOf(pair.here.object);
      EXPECT_LT((state - here).cwiseAbs().maxCoeff(), 0.055) << "ln 0.21 / 0.2, and no turn";
      const UprightCovariance covariance = covarianceOf(prior);
      EXPECT_GT(std::sqrt(covariance(3, 3)), M_PI) << "any yaw will do";

      const Ellipsoid& there = pair.there.object;
      const bool isSame = (here[4] > here[5]) == (there.semiAxes().x() > there.semiAxes().y());
      const int a = isSame ? 4 : 5;
      EXPECT_NEAR(covariance(4, 4), pair.there.covariance(a, a), 1e-9);
      EXPECT_NEAR(covariance(4, 0), pair.there.covariance(a, 0), 1e-9);
    }
}

TEST(KnownObjects, TheirSidesMayErrBeyondTheMapsCovariance)
{
  constexpr double kSigma = 0.01;
  const Pair pair{boxAt(0.4, 0.35, 0.2), boxAt(0.4, 0.35, 0.2)};
  const ObjectPrior prior = priorOf(pair.here, pair.there, kSigma);
  const UprightCovariance more = covarianceOf(prior) - pair.there.covariance;
  UprightState expected;
  expected.head<3>().setConstant(kSigma);
  const Eigen::Vector3d half = pair.there.object.semiAxes();
  for (int i = 0; i < 3; ++i)
    expected[4 + i] = 0.5 * std::log((half[i] + kSigma) / (half[i] - kSigma));
  expected[3] = std::atan2(kSigma, half.x());  // an end of the longer side goes to the side
  for (int i = 0; i < 7; ++i)
  {
    EXPECT_NEAR(std::sqrt(more(i, i)), expected[i], 2e-3 * expected[i]) << i << ": linearised";
    for (int j = 0; j < i; ++j) EXPECT_NEAR(more(i, j), 0, 1e-12) << i << " " << j;
  }
  EXPECT_EQ(prior.g.norm(), 0);
  EXPECT_GT(prior.cauchy, 0) << "it may have been moved";
}
