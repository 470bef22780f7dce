#include "quadmap/evaluation/TrajectoryAlignment.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <stdexcept>

#include "../geometry/Algebra.h"
#include "../geometry/RandomGeometry.h"
#include "quadmap/geometry/PinholeCamera.h"

using namespace quadmap;
using namespace quadmap::test;
using mrpt::poses::CPose3D;

namespace
{
Eigen::Vector3d positionOf(const CPose3D& T) { return {T.x(), T.y(), T.z()}; }
Eigen::Matrix3d rotationOf(const CPose3D& T) { return T.getRotationMatrix().asEigen(); }

CPose3D at(double x, double y, double z) { return CPose3D(x, y, z, 0, 0, 0); }

/** Pairs whose estimated poses are the true ones in a displaced world, with noise of the positions.
 */
std::vector<PosePair> displacedPairs(
    RandomGeometry& random, const CPose3D& T_truth_estimated, double noise, int count = 40)
{
  std::vector<PosePair> pairs;
  for (int i = 0; i < count; ++i)
  {
    CPose3D T_estimated_body = random.pose(2);
    const CPose3D T_truth_body = T_truth_estimated + T_estimated_body;
    const Eigen::Vector3d e = random.vector(-noise, noise);
    T_estimated_body.x_incr(e.x());
    T_estimated_body.y_incr(e.y());
    T_estimated_body.z_incr(e.z());
    pairs.push_back({T_truth_body, T_estimated_body});
  }
  return pairs;
}

/** Horn's closed form: the unit quaternion is the eigenvector of a 4x4 matrix. */
Eigen::Matrix3d hornRotation(const std::vector<PosePair>& pairs)
{
  Eigen::Vector3d meanA = Eigen::Vector3d::Zero(), meanB = Eigen::Vector3d::Zero();
  for (const auto& p : pairs)
  {
    meanA += positionOf(p.T_estimated_body) / double(pairs.size());
    meanB += positionOf(p.T_truth_body) / double(pairs.size());
  }
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (const auto& p : pairs)
    S +=
        (positionOf(p.T_estimated_body) - meanA) * (positionOf(p.T_truth_body) - meanB).transpose();
  Eigen::Matrix4d N;
  N << S.trace(), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0),                   //
      S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2),  //
      S(2, 0) - S(0, 2), S(0, 1) + S(1, 0), S(1, 1) - S(0, 0) - S(2, 2), S(1, 2) + S(2, 1),  //
      S(0, 1) - S(1, 0), S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), S(2, 2) - S(0, 0) - S(1, 1);
  const Eigen::Vector4d q = eigenvectorsOf(N).col(3);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

double distance(const CPose3D& a, const CPose3D& b)
{
  return (a.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
          b.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen())
      .norm();
}
}  // namespace

TEST(AlignTrajectories, FindsAQuarterTurnByHand)
{
  // Estimated (x, y, z) is (y, -x, z - 5) of the truth: x_t = -y_e + 0, y_t = x_e, z_t = z_e + 5.
  std::vector<PosePair> pairs;
  for (const Eigen::Vector3d& t :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 0, 3)})
    pairs.push_back({at(t.x(), t.y(), t.z()), at(t.y(), -t.x(), t.z() - 5)});
  const auto result = alignTrajectories(pairs);
  EXPECT_EQ(result.source, AlignmentSource::Positions);
  EXPECT_LT(distance(result.T_truth_estimated, CPose3D(0, 0, 5, M_PI / 2, 0, 0)), 1e-6);
  EXPECT_NEAR(ateRmse(pairs, result.T_truth_estimated), 0, 1e-6);
}

TEST(AlignTrajectories, LeavesTheErrorThatNoMotionRemoves)
{
  // A square whose corners are alternately 0.1 m too high and too low: by symmetry neither a shift
  // nor a turn helps. ATE = 0.1 m exactly; without alignment 10 m more.
  const double e = 0.1;
  const std::vector<PosePair> pairs{
      { at(1,  1, 10),  at(1,  1,  e)},
      {at(-1,  1, 10), at(-1,  1, -e)},
      {at(-1, -1, 10), at(-1, -1,  e)},
      { at(1, -1, 10),  at(1, -1, -e)}
  };
  const auto result = alignTrajectories(pairs);
  EXPECT_LT(distance(result.T_truth_estimated, at(0, 0, 10)), 1e-6);
  EXPECT_NEAR(ateRmse(pairs, result.T_truth_estimated), e, 1e-6);
  EXPECT_NEAR(ateRmse(pairs, CPose3D()), std::sqrt(100 + e * e), 1e-6);
}

TEST(AlignTrajectories, DoesNotEstimateScale)
{
  // Twice as large: each corner of the unit square stays sqrt(2) - sqrt(2)/2 off.
  const std::vector<PosePair> pairs{
      { at(1,  1, 0),  at(.5,  .5, 0)},
      {at(-1,  1, 0), at(-.5,  .5, 0)},
      {at(-1, -1, 0), at(-.5, -.5, 0)},
      { at(1, -1, 0),  at(.5, -.5, 0)}
  };
  const auto result = alignTrajectories(pairs);
  EXPECT_NEAR(ateRmse(pairs, result.T_truth_estimated), std::sqrt(0.5), 1e-6);
}

TEST(AlignTrajectories, NeverMirrors)
{
  // The mirror image fits a reflection without error; a rotation must leave some.
  RandomGeometry random(61);
  std::vector<PosePair> pairs;
  for (int i = 0; i < 20; ++i)
  {
    const Eigen::Vector3d p = random.vector(-1, 1);
    pairs.push_back({at(p.x(), p.y(), p.z()), at(p.x(), p.y(), -p.z())});
  }
  const auto result = alignTrajectories(pairs);
  EXPECT_NEAR(rotationOf(result.T_truth_estimated).determinant(), 1, 1e-9);
  EXPECT_GT(ateRmse(pairs, result.T_truth_estimated), 0.1);
}

TEST(AlignTrajectories, AgreesWithHornsQuaternionOnNoisyData)
{
  RandomGeometry random(62);
  for (int trial = 0; trial < 30; ++trial)
  {
    const CPose3D T = random.pose(5);
    const auto pairs = displacedPairs(random, T, 0.05);
    const auto result = alignTrajectories(pairs);
    EXPECT_LT((rotationOf(result.T_truth_estimated) - hornRotation(pairs)).norm(), 1e-9);
    EXPECT_LT(distance(result.T_truth_estimated, T), 0.1) << "noise 0.05 m over 40 poses";
  }
}

TEST(AlignTrajectories, NoNearbyMotionIsBetter)
{
  RandomGeometry random(63);
  const auto pairs = displacedPairs(random, random.pose(5), 0.1);
  const CPose3D T = alignPositions(pairs);
  const double best = ateRmse(pairs, T);
  for (int i = 0; i < 200; ++i)
  {
    const Eigen::Vector3d t = random.vector(-1e-3, 1e-3);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(random.uniform(-1e-3, 1e-3), random.direction()).toRotationMatrix();
    EXPECT_GT(ateRmse(pairs, poseOf(R, t) + T), best);
    EXPECT_GT(ateRmse(pairs, T + poseOf(R, t)), best);
  }
}

TEST(AlignTrajectories, UsesOrientationsOnAStraightLineAndOnTheSpot)
{
  RandomGeometry random(64);
  for (double length : {2.0, 0.0})
    for (const CPose3D& T_body_optical : {CPose3D(), T_sensor_optical()})
    {
      const CPose3D T = random.pose(3);
      std::vector<PosePair> pairs;
      for (int i = 0; i < 20; ++i)
      {
        // Turns about two axes, which tell the bodies' frames apart even on the spot.
        const CPose3D T_estimated_body(length * i / 20, 0, 0, 0.03 * i, 0.01 * i, 0);
        pairs.push_back({T + T_estimated_body + T_body_optical, T_estimated_body});
      }
      const auto result = alignTrajectories(pairs);
      EXPECT_EQ(result.source, AlignmentSource::Orientations);
      EXPECT_LT(result.secondSpread, 1e-6);
      EXPECT_LT(distance(result.T_truth_estimated, T), 1e-6) << "length " << length;
    }
}

TEST(AlignTrajectories, OfADriftingWayAlongACorridorUsesOrientations)
{
  // 18 m there and back, 0.2 m to either side. On the way back the estimate has risen: the turn
  // about the corridor that fits the positions best is that of the drift, not of the world.
  std::vector<PosePair> pairs;
  for (int i = 0; i <= 100; ++i)
  {
    const bool back = i > 50;
    const CPose3D truth(
        0.36 * (back ? 100 - i : i), back ? 0.2 : -0.2, 0.4, back ? M_PI : 0.0, 0, 0);
    CPose3D estimated = truth;
    estimated.z_incr(back ? 0.2 : -0.2);
    pairs.push_back({truth, estimated});
  }
  EXPECT_GT(std::abs(alignPositions(pairs).roll()), mrpt::DEG2RAD(20.0));
  const auto result = alignTrajectories(pairs);
  EXPECT_EQ(result.source, AlignmentSource::Orientations);
  EXPECT_LT(std::abs(result.T_truth_estimated.roll()), mrpt::DEG2RAD(4.0));
}

TEST(AlignTrajectories, OfASinglePoseIsItsRelativePose)
{
  const CPose3D T(1, 2, 3, 0.4, 0.1, -0.2), T_estimated_body(0.5, 0, 1, 1, 0, 0);
  const auto result = alignTrajectories({
      {T + T_estimated_body, T_estimated_body}
  });
  EXPECT_EQ(result.source, AlignmentSource::Orientations);
  EXPECT_LT(distance(result.T_truth_estimated, T), 1e-6);
}

TEST(AlignTrajectories, NeedsAPair)
{
  EXPECT_THROW(alignTrajectories({}), std::invalid_argument);
  EXPECT_THROW(ateRmse({}, CPose3D()), std::invalid_argument);
}

TEST(PairByTime, TakesTheNearestWithinTheLimit)
{
  const Trajectory truth{
      {0.0, at(0, 0, 0)},
      {1.0, at(1, 0, 0)},
      {2.0, at(2, 0, 0)}
  };
  const Trajectory estimated{
      {0.015, at(10, 0, 0)},
      {  1.5, at(11, 0, 0)},
      {1.985, at(12, 0, 0)},
      {    9, at(13, 0, 0)}
  };
  const auto pairs = pairByTime(truth, estimated);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].T_truth_body.x(), 0);
  EXPECT_EQ(pairs[0].T_estimated_body.x(), 10);
  EXPECT_EQ(pairs[1].T_truth_body.x(), 2);
  EXPECT_EQ(pairs[1].T_estimated_body.x(), 12);
  EXPECT_EQ(pairByTime(truth, estimated, 0.5).size(), 3u);
  EXPECT_EQ(pairByTime(truth, estimated, 0.01).size(), 0u);
}

TEST(PairByTime, GivesATruePoseToOneEstimatedPoseAndIgnoresTheOrder)
{
  const Trajectory truth{
      {2.0, at(2, 0, 0)},
      {1.0, at(1, 0, 0)}
  };
  const Trajectory estimated{
      { 2.01, at(12, 0, 0)},
      {1.012, at(10, 0, 0)},
      {0.995, at(11, 0, 0)}
  };
  const auto pairs = pairByTime(truth, estimated);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].T_truth_body.x(), 1);
  EXPECT_EQ(pairs[0].T_estimated_body.x(), 11) << "5 ms off, the other 12 ms";
  EXPECT_EQ(pairs[1].T_estimated_body.x(), 12);
}

TEST(PairByTime, OfEmptyTrajectoriesIsEmpty)
{
  EXPECT_TRUE(pairByTime(
                  {
  },
                  {{0, CPose3D()}})
                  .empty());
  EXPECT_TRUE(pairByTime(
                  {
                      {0, CPose3D()}
  },
                  {})
                  .empty());
}
