#include "PointFilter.h"

#include <gtest/gtest.h>

#include "PointGraph.h"
#include "PointWorld.h"

using namespace quadmap;

namespace
{
/** Compares the filter's last pose and objects after a walk with those of the graph, which
 * estimates all poses at once by other means. */
template <int D>
void expectAgreement()
{
  PointWorldOptions options;
  options.poses = 15;
  options.objects = 4;
  options.area = 4;
  options.separation = 0.3;
  options.fieldOfView = 6;
  options.clutterShare = 0;
  options.sigma = options.odometrySigma = options.turnSigma = 1e-4;  // so that all is linear
  const PointWorld<D> world(5, options);

  PointFilter<D> filter;
  filter.reset(
      world.truth.front(), {}, Eigen::MatrixXd::Zero(kPoseIncrement<D>, kPoseIncrement<D>));
  PointGraph<D> graph;
  graph.poses = world.drifted();
  graph.steps.assign(world.odometry.begin() + 1, world.odometry.end());
  std::map<std::uint32_t, std::size_t> indexOf;
  for (std::size_t k = 0; k < world.truth.size(); ++k)
  {
    if (k > 0) filter.predict(world.odometry[k]);
    for (const auto& z : world.detections[k])
    {
      const bool isNew = indexOf.emplace(*z.instance, indexOf.size()).second;
      const std::size_t i = indexOf[*z.instance];
      if (isNew)
      {
        filter.add(z);
        graph.objects.push_back(world.objects[*z.instance]);
      }
      else
        filter.update(i, z);
      graph.sights.push_back({k, i, z.position, z.covariance});
    }
  }
  graph.optimise(1e6, 50);
  typename PointGraph<D>::PoseMarginal last;
  const Eigen::MatrixXd objects = graph.marginals(
      1e6,
      [&](std::size_t, const auto& marginal, const auto&)
      {
        last = marginal;
        return false;
      });
  constexpr double kSmall = 1e-6;  // a hundredth of a sigma [m]
  EXPECT_LT((filter.pose().t - graph.poses.back().t).norm(), kSmall);
  for (std::size_t i = 0; i < graph.objects.size(); ++i)
    EXPECT_LT((filter.position(i) - graph.objects[i]).norm(), kSmall);
  const auto n = D * static_cast<Eigen::Index>(graph.objects.size());
  const double scale = objects.cwiseAbs().maxCoeff();
  EXPECT_LT(
      (filter.covariance().bottomRightCorner(n, n) - objects).cwiseAbs().maxCoeff(), 0.01 * scale);
  EXPECT_LT(
      (filter.covariance().topRightCorner(kPoseIncrement<D>, n) - last.poseObjects)
          .cwiseAbs()
          .maxCoeff(),
      0.01 * scale);
}

}  // namespace

TEST(PointFilter, AgreesWithTheGraphInThePlane) { expectAgreement<2>(); }
TEST(PointFilter, AgreesWithTheGraphInSpace) { expectAgreement<3>(); }

TEST(PointFilter, ForgottenObjectsLeaveTheOthers)
{
  PointFilter<2> filter;
  filter.reset({}, {}, 0.01 * Eigen::Matrix3d::Identity());
  for (const double x : {1.0, 2.0, 3.0})
  {
    PointMeasurement<2> z;
    z.position = {x, 0.5};
    filter.add(z);
  }
  const Eigen::Matrix2d third = filter.objectCovariance(2);
  filter.remove(1);
  ASSERT_EQ(2u, filter.objects());
  EXPECT_EQ(3.0, filter.position(1).x());
  EXPECT_EQ(third, filter.objectCovariance(1));
}
