#include "quadmap/graph/GraphState.h"

#include <ceres/manifold.h>

#include "FactorCheck.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
const CPose3D kPose(1, -2, 0.5, 2.5, 0.3, -0.4);

/** The laws of a manifold, at x and at a point one step away. */
void expectLaws(const Block& x)
{
  const ceres::Manifold& m = *x.manifold;
  const int n = m.TangentSize();
  for (int c = 0; c < n; ++c)
  {
    std::vector<double> step(static_cast<std::size_t>(n), 0.0);
    step[static_cast<std::size_t>(c)] = 0.37;
    const Block y = x.moved(c, 0.37);
    std::vector<double> back(static_cast<std::size_t>(n));
    ASSERT_TRUE(m.Minus(y.values.data(), x.values.data(), back.data()));
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(back[static_cast<std::size_t>(i)], step[static_cast<std::size_t>(i)], 1e-12);
  }
  RowMajor plus(m.AmbientSize(), n), minus(n, m.AmbientSize());
  ASSERT_TRUE(m.PlusJacobian(x.values.data(), plus.data()));
  ASSERT_TRUE(m.MinusJacobian(x.values.data(), minus.data()));
  EXPECT_LT((minus * plus - RowMajor::Identity(n, n)).norm(), 1e-12);
  for (int c = 0; c < n; ++c)
  {
    const Block up = x.moved(c, 1e-6), down = x.moved(c, -1e-6);
    for (int i = 0; i < m.AmbientSize(); ++i)
    {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(plus(i, c), (up.values[k] - down.values[k]) / 2e-6, 1e-8);
    }
  }
}

}  // namespace

TEST(GraphState, PosesRoundTrip)
{
  const CPose3D back = poseOf(poseBlockOf(kPose));
  EXPECT_LT(
      (back.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
       kPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen())
          .norm(),
      1e-12);
}

TEST(GraphState, ObjectsRoundTripUprightAndFree)
{
  const Ellipsoid upright(CPose3D(1, 2, 3, -2.0, 0, 0), {0.3, 0.2, 0.9});
  const Ellipsoid leaning(CPose3D(1, 2, 3, -2.0, 0.7, 0.2), {0.3, 0.2, 0.9});
  const auto distance = [](const Ellipsoid& a, const Ellipsoid& b)
  { return (a.dualQuadric() - b.dualQuadric()).norm(); };
  EXPECT_LT(
      distance(
          upright,
          objectOf(objectBlockOf(upright, ObjectFreedom::Upright), ObjectFreedom::Upright)),
      1e-12);
  EXPECT_LT(
      distance(leaning, objectOf(objectBlockOf(leaning, ObjectFreedom::Free), ObjectFreedom::Free)),
      1e-12);
}

TEST(GraphState, StepsObeyTheLawsOfAManifold)
{
  expectLaws(poseBlock(kPose));
  expectLaws(objectBlock(Ellipsoid(kPose, {0.3, 0.2, 0.9}), ObjectFreedom::Free));
  EXPECT_EQ(objectManifold(ObjectFreedom::Upright), nullptr);
}

TEST(GraphState, StepsTurnAboutTheAxesOfTheMap)
{
  const Block moved = poseBlock(kPose).moved(2, 0.2);  // about z
  PoseBlock block;
  std::copy(moved.values.begin(), moved.values.end(), block.begin());
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * kPose.getRotationMatrix().asEigen();
  EXPECT_LT((poseOf(block).getRotationMatrix().asEigen() - expected).norm(), 1e-12);
  EXPECT_NEAR(poseOf(block).x(), kPose.x(), 1e-12) << "the robot stays where it is";
}
