// The joint estimate of two maps against the same problem solved densely, with numeric derivatives.
#include "merging/JointAlignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/NormalEquations.h"

using namespace quadmap;

namespace
{
const ShiftAndYaw kTrue(1.5, -0.7, 0.1, 2.1);

InformationPrior randomInformation(const UprightState& at, std::mt19937& rng)
{
  std::normal_distribution<double> any(0, 40);
  Eigen::Matrix<double, 9, 7> J;
  for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = any(rng);
  InformationPrior known;
  known.L = J.transpose() * J;
  known.xi = known.L * at;
  known.complete = known.yawDefined = 10;
  return known;
}

std::vector<KnownPair> randomPairs(std::mt19937& rng)
{
  std::normal_distribution<double> error(0, 0.005);
  std::uniform_real_distribution<double> place(-3, 3), size(-1.5, 0);
  std::vector<KnownPair> pairs;
  for (int i = 0; i < 5; ++i)
  {
    UprightState truth, ownError, otherError;
    for (Eigen::Index k = 0; k < 7; ++k)
    {
      truth[k] = k < 4 ? place(rng) : size(rng);
      ownError[k] = error(rng);
      otherError[k] = error(rng);
    }
    KnownPair pair;
    pair.own.state = truth + ownError;
    pair.other.state = StateShift(kTrue).back(truth) + otherError;
    for (KnownState* known : {&pair.own, &pair.other})
    {
      known->known = randomInformation(known->state, rng);
      known->hasHeading = true;
    }
    pairs.push_back(pair);
  }
  return pairs;
}

/** Twice the cost of the whole problem, without robust kernels, at (place, states). */
double costAt(
    const Eigen::VectorXd& x, const std::vector<KnownPair>& pairs, const EstimatorOptions& options)
{
  const StateShift shift(x.head<4>());
  double cost = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const UprightState s = x.segment<7>(4 + 7 * static_cast<Eigen::Index>(i));
    const UprightState own = s - pairs[i].own.state, other = shift.back(s) - pairs[i].other.state;
    cost += own.dot(pairs[i].own.known.L * own) + other.dot(pairs[i].other.known.L * other);
    for (const auto& row : labelPriorRows(s.tail<3>(), pairs[i].label, options))
      cost += row.r * row.r;
  }
  return cost;
}

}  // namespace

TEST(JointAlignment, IsTheMinimumOfTheWholeProblem)
{
  std::mt19937 rng(1);
  const auto pairs = randomPairs(rng);
  const EstimatorOptions options;
  const JointEstimate joint = estimateJointly(pairs, kTrue, options);
  Eigen::VectorXd x(4 + 7 * static_cast<Eigen::Index>(pairs.size()));
  x.head<4>() = joint.T_own_other;
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    x.segment<7>(4 + 7 * static_cast<Eigen::Index>(i)) = joint.objects[i].state;
    EXPECT_LT(joint.objects[i].distance, 2) << "no kernel is at work here";
  }
  const double least = costAt(x, pairs, options);
  constexpr double kStep = 1e-4;
  for (Eigen::Index k = 0; k < x.size(); ++k)
  {
    Eigen::VectorXd ahead = x, behind = x;
    ahead[k] += kStep;
    behind[k] -= kStep;
    EXPECT_GE(costAt(ahead, pairs, options), least) << k;
    EXPECT_GE(costAt(behind, pairs, options), least) << k;
  }
}

TEST(JointAlignment, HasTheCovarianceOfTheWholeProblem)
{
  std::mt19937 rng(2);
  const auto pairs = randomPairs(rng);
  const EstimatorOptions options;
  const JointEstimate joint = estimateJointly(pairs, kTrue, options);
  const auto n = 4 + 7 * static_cast<Eigen::Index>(pairs.size());
  Eigen::VectorXd x(n);
  x.head<4>() = joint.T_own_other;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    x.segment<7>(4 + 7 * static_cast<Eigen::Index>(i)) = joint.objects[i].state;
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd H(n, n);
  const auto at = [&](Eigen::Index a, double sa, Eigen::Index b, double sb)
  {
    Eigen::VectorXd y = x;
    y[a] += sa * kStep;
    y[b] += sb * kStep;
    return costAt(y, pairs, options) / 2;
  };
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      H(a, b) = (at(a, 1, b, 1) - at(a, 1, b, -1) - at(a, -1, b, 1) + at(a, -1, b, -1)) /
                (4 * kStep * kStep);
  const Eigen::MatrixXd P = H.inverse();
  // Far from linear the two differ by what the objects' errors curve; weights of the kernel, too.
  EXPECT_LT((joint.covariance - P.topLeftCorner<4, 4>()).norm(), 0.15 * joint.covariance.norm());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto at7 = 4 + 7 * static_cast<Eigen::Index>(i);
    const UprightCovariance whole = P.block(at7, at7, 7, 7);
    NormalEquations prior;
    for (const auto& row :
         labelPriorRows(joint.objects[i].state.tail<3>(), pairs[i].label, options))
      prior.add(row.r, row.byUprightState(), RobustKernel::quadratic());
    const UprightCovariance claimed =
        UprightCovariance((joint.objects[i].known.L + prior.H).inverse()) +
        joint.objects[i].sharedError;
    EXPECT_LT((claimed - whole).norm(), 0.15 * whole.norm()) << i;
  }
}

TEST(JointAlignment, LetsGoOfWhatIsSomewhereElse)
{
  std::mt19937 rng(3);
  auto pairs = randomPairs(rng);
  const EstimatorOptions options;
  pairs[0].other.state[0] += 0.3;
  pairs[0].other.known.xi = pairs[0].other.known.L * pairs[0].other.state;
  const JointEstimate joint = estimateJointly(pairs, kTrue, options);
  EXPECT_LT((joint.T_own_other - kTrue).norm(), 0.03);
  EXPECT_GT(joint.objects[0].distance, 5);
}
