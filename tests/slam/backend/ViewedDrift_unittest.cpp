#include "backend/ViewedDrift.h"

#include <gtest/gtest.h>

#include "BentDrive.h"
#include "backend/OdometryDrift.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
const StepNoise kTold{2, 3};
const auto kNeverStop = [] { return false; };

FactorGraph graphAlong(const std::vector<Keyframe>& keyframes)
{
  FactorGraph graph{FactorGraphOptions()};
  graph.setStepNoise(kTold);
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    graph.addPose(keyframes[k].T_map_robot);
    if (k > 0) graph.addStep(k - 1, k, *keyframes[k].odometryStep);
  }
  return graph;
}

const Drift::Moved kOne{
    {3, 1, 0.5},
    1, 6
},
    kOther{{-1, 2, 1}, 3, 8};

}  // namespace

TEST(ViewedDrift, OfStepsAloneIsThatOfTheOdometry)
{
  const auto keyframes = bentDrive();
  FactorGraph graph = graphAlong(keyframes);
  const OdometryDrift odometry(keyframes, kTold);
  const auto drift = ViewedDrift::of(graph, {8, 1, 3, 6}, odometry, kNeverStop);
  ASSERT_TRUE(drift);
  for (const auto& [a, b] :
       {std::pair(kOne, kOne), std::pair(kOther, kOther), std::pair(kOne, kOther)})
  {
    Eigen::Matrix3d expected = odometry.covariance(a, b);
    expected.topRightCorner<2, 1>().setZero();
    expected.bottomLeftCorner<1, 2>().setZero();
    EXPECT_LT((drift->covariance(a, b) - expected).norm(), 1e-4 * expected.norm());
  }
}

TEST(ViewedDrift, IsLessWhereMoreIsKnown)
{
  const auto keyframes = bentDrive();
  FactorGraph graph = graphAlong(keyframes);
  CPose3DPDFGaussian seen(keyframes[6].T_map_robot - keyframes[2].T_map_robot);
  for (int i = 0; i < 6; ++i) seen.cov(i, i) = 1e-7;
  graph.addKnownStep(2, 6, seen);
  const OdometryDrift odometry(keyframes, kTold);
  const auto drift = ViewedDrift::of(graph, {1, 3, 6, 8}, odometry, kNeverStop);
  ASSERT_TRUE(drift);
  const Eigen::Vector3d known = drift->covariance(kOne, kOne).diagonal(),
                        claimed = odometry.covariance(kOne, kOne).diagonal();
  EXPECT_LT(known.head<2>().sum(), 0.5 * claimed.head<2>().sum());
  EXPECT_EQ(known.z(), claimed.z()) << "what is taken for up may be wrong";
}

TEST(ViewedDrift, IsUnknownWherePosesAreNotJoined)
{
  const auto keyframes = bentDrive();
  FactorGraph graph = graphAlong(keyframes);
  graph.addPose(CPose3D());
  EXPECT_FALSE(ViewedDrift::of(graph, {1, 3}, OdometryDrift(keyframes, kTold), kNeverStop));
}

TEST(ViewedDrift, IsNotComputedAfterAStop)
{
  const auto keyframes = bentDrive();
  FactorGraph graph = graphAlong(keyframes);
  const OdometryDrift odometry(keyframes, kTold);
  for (const int last : {1, 4})
  {
    int now = 0;
    EXPECT_FALSE(ViewedDrift::of(graph, {1, 3, 6, 8}, odometry, [&] { return ++now == last; }));
    EXPECT_EQ(now, last) << "it goes on no further";
  }
}
