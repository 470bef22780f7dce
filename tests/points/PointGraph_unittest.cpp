#include "PointGraph.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "../geometry/Algebra.h"
#include "PointWorld.h"

using namespace quadmap;

namespace
{
/** A short walk past a few things, as a graph with the true associations. */
template <int D>
PointGraph<D> shortWalk()
{
  PointWorldOptions options;
  options.poses = 12;
  options.objects = 5;
  options.area = 4;
  options.separation = 0.3;
  options.fieldOfView = 6;
  options.clutterShare = 0;
  const PointWorld<D> world(3, options);
  PointGraph<D> graph;
  graph.poses = world.drifted();
  graph.steps.assign(world.odometry.begin() + 1, world.odometry.end());
  graph.objects = world.objects;
  for (std::size_t k = 0; k < world.detections.size(); ++k)
    for (const auto& z : world.detections[k])
      graph.sights.push_back({k, *z.instance, z.position, z.covariance});
  return graph;
}

template <int D>
PointGraph<D> moved(PointGraph<D> graph, const Eigen::VectorXd& step)
{
  constexpr int kP = kPoseIncrement<D>;
  for (std::size_t k = 1; k < graph.poses.size(); ++k)
  {
    const auto first = kP * static_cast<Eigen::Index>(k - 1);
    graph.poses[k].t += step.segment<D>(first);
    graph.poses[k].R =
        rotationBy<D>(TurnVector<D>(step.segment<kTurn<D>>(first + D))) * graph.poses[k].R;
  }
  const auto firstObject = kP * static_cast<Eigen::Index>(graph.poses.size() - 1);
  for (std::size_t i = 0; i < graph.objects.size(); ++i)
    graph.objects[i] += step.segment<D>(firstObject + D * static_cast<Eigen::Index>(i));
  return graph;
}

/** All residuals in standard deviations. */
template <int D>
Eigen::VectorXd residuals(const PointGraph<D>& graph)
{
  std::vector<double> all;
  const auto add = [&](const Eigen::VectorXd& e, const Eigen::MatrixXd& covariance)
  {
    const Eigen::VectorXd r = inverseOf(rootOf(covariance)) * e;
    all.insert(all.end(), r.data(), r.data() + r.size());
  };
  for (std::size_t k = 0; k < graph.steps.size(); ++k)
  {
    const PointPose<D> is = graph.poses[k].inverse() * graph.poses[k + 1];
    const PointPose<D>& said = graph.steps[k].T_from_to;
    Eigen::VectorXd e(kPoseIncrement<D>);
    e << is.t - said.t, turnOf<D>(said.R.transpose() * is.R);
    add(e, graph.steps[k].covariance);
  }
  for (const auto& s : graph.sights)
    add(graph.poses[s.pose].inverse() * graph.objects[s.object] - s.position, s.covariance);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/** The joint covariance (J^t J)^-1, with J by differences. */
template <int D>
Eigen::MatrixXd covarianceByDifferences(const PointGraph<D>& graph)
{
  constexpr double kStep = 1e-6;
  const auto n = static_cast<Eigen::Index>(
      kPoseIncrement<D> * (graph.poses.size() - 1) + D * graph.objects.size());
  Eigen::MatrixXd J(residuals<D>(graph).size(), n);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(n, i);
    J.col(i) =
        (residuals<D>(moved<D>(graph, step)) - residuals<D>(moved<D>(graph, -step))) / (2 * kStep);
  }
  return (J.transpose() * J).inverse();
}

/** The most memory that this program has needed so far [bytes]. */
long residentBytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * usage.ru_maxrss;
}

/** Are the marginals those of the whole information matrix, whose derivatives are differences? */
template <int D>
void expectExactMarginals(const PointGraph<D>& graph)
{
  constexpr int kP = kPoseIncrement<D>;
  constexpr double kNoHuber = 1e6;
  const Eigen::MatrixXd all = covarianceByDifferences<D>(graph);
  const auto objects = D * static_cast<Eigen::Index>(graph.objects.size());
  const double tolerance = 1e-4 * all.diagonal().maxCoeff();  // error of the differences
  std::size_t next = graph.poses.size();
  const auto compare = [&](std::size_t k, const auto& marginal, const Eigen::MatrixXd&)
  {
    EXPECT_EQ(k, --next) << "from the last to the first";
    if (k == 0) return true;
    const auto first = kP * static_cast<Eigen::Index>(k - 1);
    EXPECT_LT((marginal.pose - all.block<kP, kP>(first, first)).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT(
        (marginal.poseObjects - all.block(first, all.cols() - objects, kP, objects))
            .cwiseAbs()
            .maxCoeff(),
        tolerance);
    return true;
  };
  const Eigen::MatrixXd covariance = graph.marginals(kNoHuber, compare);
  EXPECT_EQ(next, 0u);
  EXPECT_LT(
      (covariance - all.bottomRightCorner(objects, objects)).cwiseAbs().maxCoeff(), tolerance);
}

template <typename Dimension>
class PointGraphs : public ::testing::Test
{
};

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;

}  // namespace

TYPED_TEST_SUITE(PointGraphs, Dimensions);

TYPED_TEST(PointGraphs, MarginalsAreThoseOfTheWholeInformationMatrix)
{
  expectExactMarginals<TypeParam::value>(shortWalk<TypeParam::value>());
}

TYPED_TEST(PointGraphs, MarginalsAreExactFarFromTheMeasuredTurns)
{
  constexpr int D = TypeParam::value;
  PointGraph<D> graph = shortWalk<D>();
  for (std::size_t k = 0; k < graph.steps.size(); ++k)
  {
    const double angle = k % 2 ? 0.6 : -0.4;  // [rad]
    auto& R = graph.steps[k].T_from_to.R;
    R = R * rotationBy<D>(TurnVector<D>(TurnVector<D>::Constant(angle)));
  }
  expectExactMarginals<D>(graph);
}

TYPED_TEST(PointGraphs, MemoryDoesNotGrowWithPosesTimesObjects)
{
#ifdef QUADMAP_SANITIZED
  GTEST_SKIP() << "sanitizers keep what was freed";
#endif
  constexpr int D = TypeParam::value;
  constexpr std::size_t kPoses = 4000, kObjects = 80;
  PointGraph<D> graph;
  graph.poses.resize(kPoses);
  graph.steps.resize(kPoses - 1);
  graph.objects.assign(kObjects, PointVector<D>::Ones());
  for (std::size_t k = 0; k < kPoses; ++k)
    graph.sights.push_back({k, k % kObjects, PointVector<D>::Ones(), PointMatrix<D>::Identity()});
  std::size_t visited = 0;
  const long before = residentBytes();
  graph.marginals(
      1,
      [&](std::size_t, const auto&, const auto&)
      {
        ++visited;
        return true;
      });
  EXPECT_EQ(visited, kPoses);
  const double dense = 8.0 * kPoses * kPoseIncrement<D> * D * kObjects;
  EXPECT_LT(static_cast<double>(residentBytes() - before), 0.5 * dense + 8e6);
}

TYPED_TEST(PointGraphs, OptimisationEndsWhereTheGradientIsZero)
{
  constexpr int D = TypeParam::value;
  constexpr double kNoHuber = 1e6;
  PointGraph<D> graph = shortWalk<D>();
  const double before = 0.5 * residuals<D>(graph).squaredNorm();
  const double cost = graph.optimise(kNoHuber, 50);
  EXPECT_LT(cost, before);
  EXPECT_NEAR(0.5 * residuals<D>(graph).squaredNorm(), cost, 1e-6 * cost);
  const auto n = static_cast<Eigen::Index>(
      kPoseIncrement<D> * (graph.poses.size() - 1) + D * graph.objects.size());
  for (Eigen::Index i = 0; i < n; ++i)
    for (const double step : {-1e-3, 1e-3})
      EXPECT_GT(
          0.5 * residuals<D>(moved<D>(graph, step * Eigen::VectorXd::Unit(n, i))).squaredNorm(),
          cost)
          << "step of entry " << i;
}

TYPED_TEST(PointGraphs, GivenPosesStay)
{
  constexpr int D = TypeParam::value;
  PointGraph<D> graph = shortWalk<D>();
  graph.posesFixed = true;
  const auto poses = graph.poses;
  graph.optimise(2.0, 50);
  for (std::size_t k = 0; k < poses.size(); ++k)
    EXPECT_LT((graph.poses[k].t - poses[k].t).norm(), 1e-12);
}
