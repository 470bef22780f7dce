#include "backend/PoseMarginals.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Sparse>

#include "../../geometry/Algebra.h"
#include "../../graph/GraphWorld.h"
#include "SparseInverse.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace
{
FactorGraphOptions gaussian()
{
  FactorGraphOptions options;
  options.floorSigma = 0;
  options.estimator.huber = 1e6;
  return options;
}

/** The pose after a step (w, d). */
CPose3D stepped(const CPose3D& T, const Vector6& step)
{
  const Eigen::Matrix3d R = rotationOf(Eigen::Vector3d(step.head<3>())).toRotationMatrix() *
                            T.getRotationMatrix().asEigen();
  return {
      mrpt::math::CMatrixDouble33(R),
      mrpt::math::TPoint3D(T.x() + step[3], T.y() + step[4], T.z() + step[5])};
}

/** (w, d) from the truth to an estimate. */
Vector6 stepBetween(const CPose3D& truth, const CPose3D& estimate)
{
  const Eigen::Matrix3d turn =
      estimate.getRotationMatrix().asEigen() * truth.getRotationMatrix().asEigen().transpose();
  Vector6 step;
  step << rotationVectorOf(Eigen::Quaterniond(turn)), estimate.x() - truth.x(),
      estimate.y() - truth.y(), estimate.z() - truth.z();
  return step;
}

/** A short drive, measured without error: residuals are zero and bend the cost by nothing but their
 * derivatives. */
struct ExactDrive
{
  /** \param looseness Factor on the sigmas of steps and faces. */
  explicit ExactDrive(double looseness) : world(5, size(looseness)), graph(oneStep())
  {
    for (std::size_t k = 0; k < world.truth.size(); ++k)
    {
      graph.addPose(world.truth[k]);
      if (k > 0) addStep(k);
      for (std::size_t i = 0; i < world.objects.size(); ++i)
        if (world.visible(k, i)) addView(k, i);
    }
  }

  /** Of the free poses, then of the objects. */
  Eigen::Index steps() const
  {
    return static_cast<Eigen::Index>(6 * (world.truth.size() - 1) + 7 * seen.size());
  }

  double costAt(const Eigen::VectorXd& step) const
  {
    FactorGraph moved = graph;
    Eigen::Index at = 0;
    for (std::size_t k = 1; k < world.truth.size(); ++k, at += 6)
      moved.setPose(k, stepped(world.truth[k], step.segment<6>(at)));
    for (std::size_t i = 0; i < seen.size(); ++i, at += 7)
    {
      const UprightState x = uprightStateOf(world.objects[seen[i]]) + step.segment<7>(at);
      moved.setObject(static_cast<ObjectId>(seen[i] + 1), ellipsoidOf(x), labelOf(seen[i]));
    }
    return moved.optimise().initialCost;
  }

  GraphWorld world;
  FactorGraph graph;
  std::vector<std::size_t> seen;  // objects

 private:
  static GraphWorld::Size size(double looseness)
  {
    GraphWorld::Size size;
    for (double* sigma : {&size.faceSigma, &size.stepSigma, &size.stepAngle}) *sigma *= looseness;
    size.poses = 4;
    size.circles = 0.3;
    return size;
  }
  static FactorGraphOptions oneStep()
  {
    FactorGraphOptions options = gaussian();
    options.maxIterations = 1;
    return options;
  }

  LabelProperties labelOf(std::size_t i) const
  {
    LabelProperties label = world.label();
    label.typicalSize = 2 * world.objects[i].semiAxes();
    return label;
  }

  void addStep(std::size_t k)
  {
    auto step = world.stepDistribution(world.truth[k] - world.truth[k - 1]);
    for (int i = 0; i < 6; ++i) step.cov(i, i) *= 1 + i;  // no two alike
    graph.addStep(k - 1, k, step);
  }

  void addView(std::size_t k, std::size_t i)
  {
    const auto id = static_cast<ObjectId>(i + 1);
    const Ellipsoid object = world.objects[i].transformed(-world.truth[k]);
    BoxMeasurement view = world.view(k, i);
    view.center = object.center();
    view.axes = object.rotation();
    view.halfSizes = object.semiAxes();
    for (auto& face : view.faces) face.kind = FaceKind::Measured;
    if (!graph.hasObject(id))
    {
      graph.setObject(id, world.objects[i], labelOf(i));
      seen.push_back(i);
    }
    graph.addView(k, id, view);
  }
};

/** A chain of blocks of six that share blocks of seven, as poses and objects do. */
Eigen::SparseMatrix<double> chainWithObjects(int poses, int objects)
{
  std::mt19937 random(poses);
  std::normal_distribution<double> gauss(0, 1);
  const int columns = 6 * poses + 7 * objects;
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  const auto factor = [&](int first, int second, int width)
  {
    for (int r = 0; r < 6; ++r, ++row)
    {
      for (int c = 0; c < 6; ++c) entries.emplace_back(row, first + c, gauss(random));
      for (int c = 0; c < width; ++c) entries.emplace_back(row, second + c, gauss(random));
    }
  };
  for (int k = 0; k < poses; ++k)
  {
    factor(6 * k, 6 * (k + 1 < poses ? k + 1 : 0), k + 1 < poses ? 6 : 0);
    factor(6 * k, 6 * poses + 7 * (k % objects), 7);
  }
  for (int c = 0; c < columns; ++c, ++row) entries.emplace_back(row, c, 0.3);
  Eigen::SparseMatrix<double> J(row, columns);
  J.setFromTriplets(entries.begin(), entries.end());
  return J.transpose() * J;
}
}  // namespace

TEST(SparseInverse, IsTheDenseInverseWhereItIsKnown)
{
  const std::pair<int, int> sizes[] = {
      { 1,  1},
      { 5,  2},
      {20,  3},
      {30, 11}
  };
  for (const auto& [poses, objects] : sizes)
  {
    const Eigen::SparseMatrix<double> H = chainWithObjects(poses, objects);
    const SparseInverse inverse(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>{H});
    const Eigen::MatrixXd dense = inverseOf(H);
    const double rounding = 1e-11 * dense.norm();
    for (int k = 0; k < poses; ++k)
      EXPECT_LT((inverse.block(6 * k, 6) - dense.block(6 * k, 6 * k, 6, 6)).norm(), rounding);
    for (int i = 0; i < objects; ++i)
    {
      const int at = 6 * poses + 7 * i;
      EXPECT_LT((inverse.block(at, 7) - dense.block(at, at, 7, 7)).norm(), rounding);
    }
  }
}

class PoseMarginalsOfADrive : public ::testing::TestWithParam<double>
{
};

TEST_P(PoseMarginalsOfADrive, AgreeWithTheDenseInverse)
{
  const ExactDrive drive(GetParam());
  ASSERT_GE(drive.seen.size(), 2u);
  constexpr double kStep = 1e-4;
  const Eigen::Index n = drive.steps();
  Eigen::MatrixXd H(n, n);  // oracle: second derivatives of the cost, and their dense inverse
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
    {
      const Eigen::VectorXd a = kStep * Eigen::VectorXd::Unit(n, i);
      const Eigen::VectorXd b = kStep * Eigen::VectorXd::Unit(n, j);
      const double crossed =
          drive.costAt(a + b) - drive.costAt(a - b) - drive.costAt(b - a) + drive.costAt(-a - b);
      H(i, j) = H(j, i) = crossed / (4 * kStep * kStep);
    }
  const Eigen::MatrixXd expected = inverseOf(H);
  FactorGraph graph = drive.graph;
  const auto marginals = graph.poseMarginals();
  ASSERT_EQ(marginals.size(), drive.world.truth.size());
  EXPECT_TRUE(marginals[0].isZero());
  for (std::size_t k = 1; k < marginals.size(); ++k)
  {
    const auto at = static_cast<Eigen::Index>(6 * (k - 1));
    const Matrix6 oracle = expected.block<6, 6>(at, at);
    EXPECT_LT((marginals[k] - oracle).norm(), 0.002 * oracle.norm()) << k;
  }

  const std::vector<std::size_t> some = {3, 0, 1};
  const auto joint = graph.jointMarginal(some);
  ASSERT_TRUE(joint);
  Eigen::MatrixXd oracle = Eigen::MatrixXd::Zero(18, 18);
  for (const int r : {0, 2})
    for (const int c : {0, 2})
      oracle.block<6, 6>(6 * r, 6 * c) = expected.block<6, 6>(
          6 * (static_cast<Eigen::Index>(some[r]) - 1),
          6 * (static_cast<Eigen::Index>(some[c]) - 1));
  EXPECT_LT((*joint - oracle).norm(), 0.002 * oracle.norm());
}

// With loose steps the poses are as unsure as a room is wide: nothing else may hold them.
INSTANTIATE_TEST_SUITE_P(Sigmas, PoseMarginalsOfADrive, ::testing::Values(1.0, 50.0));

TEST(PoseMarginals, AreHonestAllAlongADrive)
{
  GraphWorld::Size size;
  size.poses = 25;
  size.circles = 0.4;
  constexpr int kWorlds = 120;
  double middle = 0;  // normalised squared errors
  for (unsigned seed = 0; seed < kWorlds; ++seed)
  {
    GraphWorld world(300 + seed, size);
    FactorGraph graph = world.graph(gaussian());
    graph.optimise();
    const auto marginals = graph.poseMarginals();
    // The other one knows of each object beforehand where it is, to 2 m.
    const Matrix6 more = marginals.back() - graph.marginals(0, false).lastPose;
    ASSERT_LT(more.norm(), 0.01 * marginals.back().norm());
    const double least = eigenvaluesOf(more)[0];
    ASSERT_GT(least, -1e-9 * marginals.back().norm()) << "knowing more cannot make less sure";
    const Vector6 e = stepBetween(world.truth[12], graph.pose(12));
    middle += squaredError(e, marginals[12]) / kWorlds;
  }
  EXPECT_NEAR(middle, 6, 1.0) << "six degrees of freedom; standard error sqrt(2 * 6 / 120) = 0.32";
}

TEST(PoseMarginals, NothingIsSaidOfPosesThatNothingHolds)
{
  FactorGraph graph(gaussian());
  graph.addPose(CPose3D());
  EXPECT_EQ(graph.poseMarginals().size(), 1u);
  graph.addPose(CPose3D(1, 0, 0, 0, 0, 0));
  EXPECT_TRUE(graph.poseMarginals().empty());
  EXPECT_FALSE(graph.jointMarginal({0, 1}));
}

TEST(PoseMarginals, BecomeThoseOfYawPitchAndRoll)
{
  Matrix6 covariance = 0.04 * Matrix6::Identity();
  const Vector6 together = (Vector6() << 0.1, -0.2, 0.3, 0.2, 0.1, -0.1).finished();
  covariance += together * together.transpose();
  for (const auto& T : {CPose3D(1, 2, 3, 0.5, -0.4, 0.2), CPose3D(0, 0, 0, -3, 1.2, 2.5)})
  {
    Matrix6 J;  // oracle: differences
    constexpr double kStep = 1e-6;
    for (Eigen::Index i = 0; i < 6; ++i)
    {
      const Vector6 step = kStep * Vector6::Unit(i);
      const CPose3D plus = stepped(T, step), minus = stepped(T, -step);
      for (unsigned row = 0; row < 6; ++row)
        J(row, i) = mrpt::math::wrapToPi(plus[row] - minus[row]) / (2 * kStep);
    }
    const Matrix6 expected = J * covariance * J.transpose();
    const auto got = covarianceOfPose(T, covariance);
    ASSERT_TRUE(got);
    EXPECT_LT((got->asEigen() - expected).norm(), 1e-6 * expected.norm());
  }
  EXPECT_FALSE(covarianceOfPose(CPose3D(0, 0, 0, 0, M_PI / 2, 0), covariance));
}
