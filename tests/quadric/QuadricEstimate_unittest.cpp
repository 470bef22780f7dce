#include "quadmap/quadric/QuadricEstimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "BoxScene.h"
#include "quadmap/estimation/Association.h"
#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
const Ellipsoid kObject(CPose3D(0.4, 0.2, 0.5, 0.5, 0.1, -0.05), {0.35, 0.2, 0.3});

LabelProperties label()
{
  LabelProperties p;
  p.typicalSize = {0.6, 0.5, 0.55};
  p.sizeSpread = 0.5;
  return p;
}

CPose3D turned(const CPose3D& pose, const Eigen::Vector3d& w, const Eigen::Vector3d& move)
{
  const Eigen::Quaterniond q = rotationOf(w);
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = q.toRotationMatrix() * pose.getRotationMatrix().asEigen();
  T.topRightCorner<3, 1>() = Eigen::Vector3d(pose.x(), pose.y(), pose.z()) + move;
  return CPose3D(mrpt::math::CMatrixDouble44(T));
}

/** The gaps of all edges after steps of the object (d, w, d ln s) and of the robot (w, d). */
Eigen::Vector4d gaps(
    const BoxView& view,
    const CPose3D& T_map_robot,
    const Eigen::Matrix<double, 9, 1>& objectStep,
    const Eigen::Matrix<double, 6, 1>& poseStep)
{
  const Ellipsoid object(
      turned(kObject.pose(), objectStep.segment<3>(3), objectStep.head<3>()),
      kObject.semiAxes().cwiseProduct(Eigen::Vector3d(objectStep.tail<3>().array().exp())));
  const auto placed = view.placedAt(turned(T_map_robot, poseStep.head<3>(), poseStep.tail<3>()));
  Eigen::Vector4d r;
  for (std::size_t e = 0; e < 4; ++e)
    r[static_cast<Eigen::Index>(e)] = tangencyResidual(placed.edges[e], object);
  return r;
}

}  // namespace

TEST(QuadricEstimate, FindsTheEllipsoidFromTheUsualSize)
{
  std::vector<BoxView> views;
  std::vector<CPose3D> robots;
  for (int i = 0; i < 15; ++i)
  {
    robots.push_back(robotOnCircle(kObject.center(), 0.2 * i));
    views.push_back(viewOf(kObject, robots.back(), static_cast<std::size_t>(i)));
  }
  std::vector<PosedView> posed;
  for (std::size_t i = 0; i < views.size(); ++i) posed.push_back({&views[i], robots[i]});
  const Ellipsoid start = usualObjectIn(views[0], robots[0], label());
  EXPECT_LT((start.center() - kObject.center()).norm(), 0.6) << "[m], sizes differ by a tenth";
  const auto found = estimateQuadric(posed, start, label(), InsertionOptions());
  EXPECT_LT((found.object.center() - kObject.center()).norm(), 0.02) << "[m]";
  EXPECT_NEAR(std::cbrt(found.object.cuboidVolume() / kObject.cuboidVolume()), 1, 0.05);
  EXPECT_LT(std::sqrt(found.covariance.diagonal().head<3>().maxCoeff()), 0.05) << "[m]";
}

TEST(QuadricEstimate, OneViewKnowsTheDirectionButNotTheDistance)
{
  const CPose3D robot = robotOnCircle(kObject.center(), 0);
  const BoxView view = viewOf(kObject, robot, 0);
  const auto found = estimateQuadric(
      {
          {&view, robot}
  },
      usualObjectIn(view, robot, label()), label(), InsertionOptions());
  const Eigen::Vector3d along = (kObject.center() - view.placedAt(robot).camera).normalized();
  const Eigen::Vector3d across = along.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Matrix3d S = found.covariance.topLeftCorner<3, 3>();
  EXPECT_GT(std::sqrt(along.dot(S * along)), 0.3) << "[m], sizes are known within a factor 1.6";
  EXPECT_LT(std::sqrt(across.dot(S * across)), 0.2) << "[m]";
}

TEST(BoxLogLikelihoodRatio, IsTheNormalDensityWithNumericDerivatives)
{
  const InsertionOptions options;
  const CPose3D robot = robotOnCircle(kObject.center(), 0.4);
  const BoxView view = viewOf(kObject, robot, 0, {4, -3, 6, 2});
  QuadricCovariance C = QuadricCovariance::Identity() * 0.01;
  C(0, 4) = C(4, 0) = 0.004;
  Eigen::Matrix<double, 6, 6> P = Eigen::Matrix<double, 6, 6>::Identity() * 0.0004;
  P(1, 3) = P(3, 1) = 0.0001;

  const Eigen::Matrix<double, 9, 1> none9 = Eigen::Matrix<double, 9, 1>::Zero();
  const Eigen::Matrix<double, 6, 1> none6 = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 4, 9> J;
  Eigen::Matrix<double, 4, 6> K;
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < 9; ++i)
  {
    const Eigen::Matrix<double, 9, 1> d = kStep * Eigen::Matrix<double, 9, 1>::Unit(i);
    J.col(i) = (gaps(view, robot, d, none6) - gaps(view, robot, -d, none6)) / (2 * kStep);
  }
  for (Eigen::Index i = 0; i < 6; ++i)
  {
    const Eigen::Matrix<double, 6, 1> d = kStep * Eigen::Matrix<double, 6, 1>::Unit(i);
    K.col(i) = (gaps(view, robot, none9, d) - gaps(view, robot, none9, -d)) / (2 * kStep);
  }
  const PlacedBox box = view.placedAt(robot);
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
  for (const auto& edge : box.edges) ahead += edge.n;
  const double range = ahead.normalized().dot(kObject.center() - box.camera);
  const double fixed = std::pow(range * std::hypot(kEdgeSigma, options.poseNoise.angle), 2) +
                       std::pow(options.poseNoise.position, 2) +
                       std::pow(options.estimator.edgeFloor, 2) +
                       std::pow(0.15 * kObject.semiAxes().mean(), 2);
  const Eigen::Matrix4d S =
      J * C * J.transpose() + K * P * K.transpose() + fixed * Eigen::Matrix4d::Identity();
  const double expected =
      logGaussian(gaps(view, robot, none9, none6), S) + 4 * std::log(range * view.fieldOfView);
  EXPECT_NEAR(
      boxLogLikelihoodRatio({&view, robot}, kObject, C, P, options), expected,
      1e-5 * std::abs(expected));
}

TEST(BoxLogLikelihoodRatio, PrefersTheObjectOfTheBox)
{
  const InsertionOptions options;
  const QuadricCovariance C = QuadricCovariance::Identity() * 0.001;
  const Eigen::Matrix<double, 6, 6> exact = Eigen::Matrix<double, 6, 6>::Zero();
  const CPose3D robot = robotOnCircle(kObject.center(), 1);
  const BoxView view = viewOf(kObject, robot, 0);
  const auto of = [&](const Ellipsoid& object, const BoxView& seen) {
    return boxLogLikelihoodRatio({&seen, robot}, object, C, exact, options);
  };
  const Ellipsoid beside(CPose3D(0, 0.8, 0, 0, 0, 0) + kObject.pose(), kObject.semiAxes());
  const Ellipsoid larger(kObject.pose(), 1.8 * kObject.semiAxes());
  EXPECT_GT(of(kObject, view), 0) << "better than anything in the image";
  EXPECT_LT(of(beside, view), -10);
  EXPECT_LT(of(larger, view), of(kObject, view) - 5);

  const Eigen::Vector3d camera = view.placedAt(robot).camera;
  const Eigen::Vector3d behind = 2 * camera - kObject.center();
  EXPECT_EQ(
      of({CPose3D(behind.x(), behind.y(), behind.z(), 0, 0, 0), kObject.semiAxes()}, view),
      -std::numeric_limits<double>::infinity());

  BoxView cut = view;  // half of it is outside the image: it may be larger on that side only
  cut.edges[0].usable = cut.edges[2].usable = false;
  EXPECT_GT(of(larger, cut), of(larger, view));
  const Ellipsoid narrower(
      kObject.pose(), Eigen::Vector3d(0.3, 0.3, 1).cwiseProduct(kObject.semiAxes()));
  EXPECT_LT(of(narrower, cut), of(kObject, cut) - 2) << "a cut object goes at least to the border";
}
