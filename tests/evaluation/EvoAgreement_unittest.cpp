#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "../geometry/Algebra.h"
#include "../obs/TemporaryFolder.h"
#include "quadmap/evaluation/EvaluationReport.h"

using namespace quadmap;

// What `evo_ape tum TRUTH ESTIMATE --align` is defined to give: each stamp of the shorter file with
// the nearest of the longer within 0.01 s (one of the longer may serve twice), then the least RMSE
// of the positions over all rotations and shifts.
//
// The expected numbers were derived from the same rounded files in two ways that agree to 1e-12 m:
// by Horn's closed form, which hornRmse() repeats (the program takes the rotation from a singular
// value decomposition), and by a search over rotation vectors from twelve random starts.
namespace
{
struct Case
{
  const char *truth, *estimate;
  std::size_t pairs;
  double ate;         // [m]
  double notAligned;  // [m], in place
};

const Case kCases[] = {
  // A loop held in the hand: 120 true poses against 30, stamps up to 14 ms off; two true poses
  // are the nearest of two estimated ones each.
    {  "loop_truth.tum",  "loop_estimate.tum", 24, 0.024371786439, 4.816825950},
 // More estimated poses than true ones, five of them nearest to two true ones, the last 0.5 m
  // off.
    {"sparse_truth.tum", "dense_estimate.tum", 22, 0.057267272752, 4.724764526},
 // Nearly a straight line (5 mm to its sides), the estimate's axes unlike the truth's.
    {  "line_truth.tum",  "line_estimate.tum", 20, 0.008541966638, 1.793641473},
};

std::string pathOf(const char* file)
{
  return std::string(QUADMAP_SOURCE_DIR "/tests/evaluation/trajectories/") + file;
}

EvaluationInput inputOf(const Case& c)
{
  EvaluationInput input;
  input.estimate = pathOf(c.estimate);
  input.trueTrajectoryPath = pathOf(c.truth);
  return input;
}

struct Points
{
  Eigen::Matrix3Xd truth, estimated;  //!< A pair per column [m]
};

/** Pairs every pose of the shorter trajectory with the nearest in time among all. */
Points pairsOf(const Trajectory& truth, const Trajectory& estimated, double limit)
{
  const bool truthIsShorter = truth.size() < estimated.size();
  const Trajectory& few = truthIsShorter ? truth : estimated;
  const Trajectory& many = truthIsShorter ? estimated : truth;
  const auto position = [](const StampedPose& p)
  { return Eigen::Vector3d(p.pose.x(), p.pose.y(), p.pose.z()); };
  Eigen::Matrix3Xd ofFew(3, few.size()), ofMany(3, few.size());
  Eigen::Index n = 0;
  for (const auto& one : few)
  {
    const StampedPose* nearest = &many.front();
    for (const auto& other : many)
      if (std::abs(other.time - one.time) < std::abs(nearest->time - one.time)) nearest = &other;
    if (std::abs(nearest->time - one.time) > limit) continue;
    ofFew.col(n) = position(one);
    ofMany.col(n++) = position(*nearest);
  }
  const Eigen::Matrix3Xd a = ofFew.leftCols(n), b = ofMany.leftCols(n);
  return truthIsShorter ? Points{a, b} : Points{b, a};
}

/** The least RMSE over all rigid motions, after B. K. P. Horn, "Closed-form solution of absolute
 * orientation using unit quaternions", 1987: a and b being the centred points, S = sum b a^t and q
 * the quaternion of a rotation R, sum a^t R b = q^t N(S) q is largest, lambda, at an eigenvector of
 * N, and sum |a - R b|^2 = sum |a|^2 + sum |b|^2 - 2 lambda. */
double hornRmse(const Points& points)
{
  const Eigen::Matrix3Xd a = points.truth.colwise() - points.truth.rowwise().mean();
  const Eigen::Matrix3Xd b = points.estimated.colwise() - points.estimated.rowwise().mean();
  const Eigen::Matrix3d S = b * a.transpose();
  const Eigen::Vector3d z(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  Eigen::Matrix4d N;
  N << S.trace(), z.transpose(), z, S + S.transpose() - S.trace() * Eigen::Matrix3d::Identity();
  const double lambda = eigenvaluesOf(N)[3];
  return std::sqrt(
      (a.squaredNorm() + b.squaredNorm() - 2 * lambda) / static_cast<double>(a.cols()));
}
}  // namespace

TEST(EvoAgreement, ExpectedAtesAreThoseOfHornsClosedForm)
{
  constexpr double kLimit = 0.01;  // [s]
  for (const Case& c : kCases)
  {
    const Points points =
        pairsOf(readTumTrajectory(pathOf(c.truth)), readTumTrajectory(pathOf(c.estimate)), kLimit);
    EXPECT_EQ(static_cast<std::size_t>(points.truth.cols()), c.pairs) << c.estimate;
    EXPECT_NEAR(hornRmse(points), c.ate, 1e-9) << c.estimate;
    const double squares = (points.truth - points.estimated).squaredNorm();
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(c.pairs)), c.notAligned, 1e-8);
  }
}

TEST(EvoAgreement, AteOfADisplacementMadeByHand)
{
  // Six points on the axes, each moved along its own axis, opposite ones away from each other by
  // d = 1, 1 and 5 cm: neither the mean nor sum b a^t, diagonal and positive, asks for a motion, so
  // that the RMSE is sqrt((2 + 2 + 50) / 6) = 3 cm. The estimate's world is turned by 90 degrees
  // about z, (x, y, z) to (-y, x, z), and shifted by (3, 4, 12) m.
  const TemporaryFolder folder;
  EvaluationInput input;
  input.trueTrajectoryPath = folder.write(
      "truth.tum",
      "1 1 0 0 0 0 0 1\n2 -1 0 0 0 0 0 1\n3 0 2 0 0 0 0 1\n4 0 -2 0 0 0 0 1\n5 0 0 3 0 0 0 1\n"
      "6 0 0 -3 0 0 0 1\n");
  input.estimate = folder.write(
      "estimate.tum",
      "1 3 5.01 12 0 0 0 1\n2 3 2.99 12 0 0 0 1\n3 0.99 4 12 0 0 0 1\n4 5.01 4 12 0 0 0 1\n"
      "5 3 4 15.05 0 0 0 1\n6 3 4 8.95 0 0 0 1\n");
  EXPECT_NEAR(evaluateRun(input).trajectory->ateRmse, 0.03, 1e-12);
}

TEST(EvoAgreement, AlignedAteIsThatOfTheDefinition)
{
  for (const Case& c : kCases)
  {
    const auto result = evaluateRun(inputOf(c)).trajectory;
    ASSERT_TRUE(result) << c.estimate;
    EXPECT_EQ(result->pairs, c.pairs) << c.estimate;
    EXPECT_NEAR(result->ateRmse, c.ate, 1e-9) << c.estimate;
    EXPECT_FALSE(result->ateRmseOdometry) << c.estimate;
  }
}

TEST(EvoAgreement, InPlaceNothingIsAligned)
{
  for (const Case& c : kCases)
  {
    EvaluationInput input = inputOf(c);
    input.inPlace = true;
    EXPECT_NEAR(evaluateRun(input).trajectory->ateRmse, c.notAligned, 1e-8) << c.estimate;
  }
}

TEST(EvoAgreement, AWiderLimitPairsMore)
{
  EvaluationInput input = inputOf(kCases[0]);
  input.maxTimeDifference = 0.02;
  const auto result = evaluateRun(input).trajectory;
  EXPECT_EQ(result->pairs, 30u);
  EXPECT_NEAR(result->ateRmse, 0.028151755182, 1e-9);
}

TEST(EvoAgreement, ATrajectoryAloneHasNoObjects)
{
  EvaluationInput input = inputOf(kCases[0]);
  input.trueObjectsPath = "gt.json";
  EXPECT_THROW(evaluateRun(input), std::runtime_error);
}
