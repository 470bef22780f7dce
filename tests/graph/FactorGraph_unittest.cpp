#include "quadmap/graph/FactorGraph.h"

#include <gtest/gtest.h>

#include "../geometry/Algebra.h"
#include "../maps/SyntheticScene.h"
#include "GraphWorld.h"
#include "quadmap/estimation/RepeatedErrors.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/maps/ObjectEstimator.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

TEST(FactorGraph, ObjectsCorrectADriftingRobot)
{
  for (const unsigned seed : {1u, 2u, 3u})
  {
    GraphWorld::Size size;  // everything is seen twice
    size.poses = 130;
    size.circles = 2.2;
    GraphWorld world(seed, size);
    FactorGraph graph = world.graph(plain());
    const auto summary = graph.optimise();
    EXPECT_LT(summary.finalCost, 0.5 * summary.initialCost);
    EXPECT_EQ(summary.freePoses, world.truth.size() - 1);
    const double before = positionError(world.truth, [&](auto k) { return world.odometry[k]; });
    const double after = positionError(world.truth, [&](auto k) { return graph.pose(k); });
    EXPECT_LT(after, 0.5 * before) << "odometry " << before << " m";
    EXPECT_EQ(graph.pose(0).distanceTo(world.truth[0]), 0) << "the first pose defines the map";
  }
}

TEST(FactorGraph, MarginalsAreHonest)
{
  // Normalised squared errors over many worlds: the mean of the last pose's is its six degrees of
  // freedom, that of an object's position three.
  GraphWorld::Size size;
  size.poses = 25;
  size.circles = 0.4;
  double poseSum = 0, objectSum = 0, objects = 0;
  constexpr int kWorlds = 120;
  for (unsigned seed = 0; seed < kWorlds; ++seed)
  {
    GraphWorld world(100 + seed, size);
    FactorGraphOptions options = plain();
    options.estimator.huber = 1e6;  // the noise is Gaussian
    FactorGraph graph = world.graph(options);
    graph.optimise();
    const auto marginals = graph.marginals(0, true);

    const std::size_t last = world.truth.size() - 1;
    const CPose3D estimate = graph.pose(last), truth = world.truth[last];
    const Eigen::Matrix3d turn =
        estimate.getRotationMatrix().asEigen() * truth.getRotationMatrix().asEigen().transpose();
    Eigen::Matrix<double, 6, 1> e;
    e << rotationVectorOf(Eigen::Quaterniond(turn)),
        Eigen::Vector3d(
            estimate.x() - truth.x(), estimate.y() - truth.y(), estimate.z() - truth.z());
    poseSum += squaredError(e, marginals.lastPose) / kWorlds;
    for (const auto& [id, covariance] : marginals.objects)
    {
      const Eigen::Vector3d off = graph.object(id).center() - world.objects[id - 1].center();
      objectSum += squaredError(off, covariance.topLeftCorner<3, 3>());
      objects += 1;
    }
  }
  // Standard error of the mean: sqrt(2 * 6 / 120) = 0.32.
  EXPECT_NEAR(poseSum, 6, 1.0);
  // Sides nobody saw are described by weak priors, so that a centre is not quite Gaussian; objects
  // of one world share its poses.
  EXPECT_GT(objectSum / objects, 1.5);
  EXPECT_LT(objectSum / objects, 4.0);
}

TEST(FactorGraph, AlignedMarginalsAreHonestWhereTheWorldIsMovedToFit)
{
  GraphWorld::Size size;
  size.poses = 25;
  size.circles = 0.4;
  double sum = 0, fixed = 0, objects = 0;
  for (unsigned seed = 0; seed < 120; ++seed)
  {
    GraphWorld world(100 + seed, size);
    FactorGraphOptions options = plain();
    options.estimator.huber = 1e6;  // the noise is Gaussian
    FactorGraph graph = world.graph(options);
    graph.optimise();
    const auto count = static_cast<Eigen::Index>(world.truth.size());
    Eigen::Matrix3Xd estimated(3, count), truth(3, count);
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const auto e = graph.pose(static_cast<std::size_t>(k));
      const auto& t = world.truth[static_cast<std::size_t>(k)];
      estimated.col(k) << e.x(), e.y(), e.z();
      truth.col(k) << t.x(), t.y(), t.z();
    }
    const Eigen::Isometry3d T(Eigen::Matrix4d(rigidAlignment(estimated, truth)));
    const auto given = graph.objectMarginals();
    for (const auto& [id, covariance] : graph.alignedObjectMarginals(0))
    {
      const Eigen::Vector3d off =
          T.linear().transpose() * (T * graph.object(id).center() - world.objects[id - 1].center());
      sum += squaredError(off, covariance.topLeftCorner<3, 3>());
      fixed += squaredError(off, given.at(id).topLeftCorner<3, 3>());
      objects += 1;
    }
  }
  // Bounds as above; those given all poses claim more than is true.
  EXPECT_GT(sum / objects, 1.5);
  EXPECT_LT(sum / objects, 4.0);
  EXPECT_GT(fixed / objects, 1.5 * sum / objects);
}

TEST(FactorGraph, AgreesWithTheObjectMapWhenPosesAreFixed)
{
  const TrueObject cabinet = cuboid("suitcase", {1.5, 0.4, 0.28}, {0.78, 0.43, 0.56}, 0.3);
  LabelProperties label;
  label.name = "suitcase";
  label.shapeExponent = 1.0;
  label.typicalSize = {0.6, 0.6, 0.6};
  label.sizeSpread = 0.6;

  SyntheticCamera camera(1);
  ObjectEstimator estimator;
  FactorGraph graph(plain());
  std::vector<BoxMeasurement> views;
  for (int i = 0; i < 30; ++i)
  {
    const double angle = 2 * M_PI * i / 30;
    const Eigen::Vector3d eye =
        cabinet.object.center() + Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 1);
    const auto T_map_sensor = SyntheticCamera::lookAt(eye, cabinet.object.center());
    const auto used = camera.disturbed(T_map_sensor);
    const auto obs = camera.observe(T_map_sensor, {cabinet});
    ASSERT_EQ(obs.objects.size(), 1u);
    const auto view = viewOf(obs.objects[0], used, label, PoseNoise());
    estimator.add(*view, {});
    const std::size_t pose = graph.addPose(used);
    mrpt::poses::CPose3DPDFGaussian known(used - graph.pose(0));
    for (int k = 0; k < 6; ++k) known.cov(k, k) = 1e-14;
    if (pose > 0) graph.addStep(0, pose, known);
    if (pose == 0) graph.setObject(1, cabinet.object, label);
    BoxMeasurement inGraph = measurementFromRobot(obs.objects[0], *view, used, CPose3D(), {}, 0);
    inGraph.weight = viewWeight(*view, uprightStateOf(cabinet.object));
    views.push_back(inGraph);
  }
  shareEdgeErrors(views);  // as the estimator does
  for (std::size_t pose = 0; pose < views.size(); ++pose) graph.addView(pose, 1, views[pose]);
  graph.optimise();
  EstimatorOptions independent;  // the graph takes the errors of views as such
  independent.repeatedThere = independent.repeatedAnywhere = independent.depthScaleSigma = 0;
  const auto expected = estimator.estimate(uprightStateOf(cabinet.object), label, independent);
  const UprightState x = uprightStateOf(graph.object(1));
  // The estimator weighs views against their medians, the graph here against the truth.
  EXPECT_LT((x - expected.state).cwiseAbs().maxCoeff(), 2e-3) << x.transpose() << "\n"
                                                              << expected.state.transpose();
  const auto marginals = graph.marginals(0, true);
  for (int k = 0; k < 7; ++k)
    EXPECT_NEAR(
        std::sqrt(marginals.objects.at(1)(k, k)), std::sqrt(expected.covariance(k, k)),
        0.15 * std::sqrt(expected.covariance(k, k)));
}

TEST(FactorGraph, SameCallsGiveTheSameBytes)
{
  const auto run = []
  {
    GraphWorld world(7);
    FactorGraph graph = driveOnline(world, 10);
    graph.optimise();
    std::vector<double> numbers;
    for (std::size_t k = 0; k < graph.poses(); ++k)
      for (const double x : poseBlockOf(graph.pose(k))) numbers.push_back(x);
    const auto marginals = graph.marginals(0, false);
    numbers.insert(numbers.end(), marginals.lastPose.data(), marginals.lastPose.data() + 36);
    return numbers;
  };
  EXPECT_EQ(run(), run());
}

TEST(FactorGraph, AFreeObjectFindsItsLean)
{
  FactorGraph graph(plain());
  const Ellipsoid truth(CPose3D(2, 0.3, 0.8, 0.4, 0.3, -0.2), {0.3, 0.2, 0.4});
  LabelProperties label;
  label.typicalSize = {0.6, 0.6, 0.6};
  graph.addPose(CPose3D());
  graph.setObject(
      1, Ellipsoid(CPose3D(2.1, 0.2, 0.7, 0.3, 0.1, 0), {0.4, 0.25, 0.3}), label,
      ObjectFreedom::Free);
  BoxMeasurement view;
  view.complete = view.yawDefined = true;
  view.center = truth.center();
  view.axes = truth.rotation();
  view.halfSizes = truth.semiAxes();
  for (auto& face : view.faces) face = {FaceKind::Measured, 0.005};
  view.yawSigma = view.tiltSigma = 0.01;
  for (int i = 0; i < 5; ++i) graph.addView(0, 1, view);
  graph.optimise();
  EXPECT_LT((graph.object(1).center() - truth.center()).norm(), 1e-3);
  EXPECT_LT((graph.object(1).rotation() - truth.rotation()).norm(), 5e-3);
  EXPECT_LT((graph.object(1).semiAxes() - truth.semiAxes()).norm(), 2e-3);
  EXPECT_EQ(graph.marginals(0, true).objects.at(1).rows(), 9);
}

TEST(FactorGraph, SupportsAndPriorsHoldWhatNoViewHolds)
{
  FactorGraphOptions options;
  options.floorSigma = 0.01;
  FactorGraph graph(options);
  LabelProperties standing;
  standing.typicalSize = {1, 1, 0.8};
  standing.sizeSpread = 0.1;
  standing.support = UsualSupport::Floor;
  LabelProperties cup = standing;
  cup.typicalSize = {0.1, 0.1, 0.1};
  cup.support = UsualSupport::Object;
  graph.addPose(CPose3D());
  for (const ObjectId id : {1u, 2u})
    graph.setObject(
        id, Ellipsoid(CPose3D(2, id, id == 1 ? 0.4 : 0.7, 0, 0, 0), {0.5, 0.5, 0.4}), standing);
  graph.setObject(3, Ellipsoid(CPose3D(2, 2, 1.5, 0, 0, 0), {0.05, 0.05, 0.05}), cup);
  EXPECT_THROW(graph.addView(0, 9, BoxMeasurement()), std::invalid_argument);
  BoxMeasurement seen;  // holds object 1 where it is; the others have a seed that tells little
  seen.hasSeed = true;
  seen.center = {2, 1, 0.4};
  seen.seedWhitening = Eigen::Matrix3d::Identity() / 0.01;
  graph.addView(0, 1, seen);
  seen.seedWhitening = Eigen::Matrix3d::Identity() / 0.5;
  seen.center = {2, 2, 0.7};
  graph.addView(0, 2, seen);
  seen.center = {2, 2, 1.5};
  graph.addView(0, 3, seen);
  ObjectPrior prior;
  prior.at = objectBlockOf(graph.object(1), ObjectFreedom::Upright);
  prior.L = 1e6 * Eigen::MatrixXd::Identity(7, 7);
  prior.g = Eigen::VectorXd::Zero(7);
  graph.setObjectPrior(1, prior);
  graph.optimise();
  const auto bottom = [&](ObjectId id)
  { return graph.object(id).center().z() - graph.object(id).semiAxes().z(); };
  EXPECT_NEAR(bottom(2), bottom(1), 0.03) << "both stand on one floor";
  EXPECT_NEAR(bottom(3), 1.45, 0.03) << "a cup stands on no floor";
}

TEST(FactorGraph, GraphEdgesKnowWhatTheViewsKnow)
{
  GraphWorld world(11);
  FactorGraphOptions options;
  options.floorSigma = 0;
  options.maxIterations = 1;
  FactorGraph graph(options);
  graph.addPose(world.truth[0]);
  std::size_t seen = 0;
  while (!world.visible(0, seen)) ++seen;
  BoxMeasurement view =
      world.view(0, seen);  // of an object just as seen: no residual bends the cost
  for (auto& face : view.faces) face.kind = FaceKind::Measured;
  const Ellipsoid object =
      Ellipsoid(
          CPose3D(view.center.x(), view.center.y(), view.center.z()) +
              CPose3D(mrpt::math::CMatrixDouble33(view.axes), mrpt::math::TPoint3D()),
          view.halfSizes)
          .transformed(world.truth[0]);
  graph.setObject(1, object, world.label(), ObjectFreedom::Free);
  graph.addView(0, 1, view);
  graph.addView(0, 1, view);
  const auto edges = graph.graphEdges();
  ASSERT_EQ(edges.size(), 1u);

  // Oracle: how the cost bends when the object is moved and turned about its centre a little; the
  // label's prior does not depend on it.
  constexpr double kStep = 1e-4;
  const auto costAt = [&](const Eigen::Vector3d& move, const Eigen::Vector3d& turn)
  {
    const Eigen::Vector3d c = object.center() + move;
    const Eigen::Matrix3d R = rotationOf(turn).toRotationMatrix() * object.rotation();
    FactorGraph moved = graph;
    moved.setObject(
        1,
        Ellipsoid(
            CPose3D(mrpt::math::CMatrixDouble33(R), mrpt::math::TPoint3D(c.x(), c.y(), c.z())),
            object.semiAxes()),
        world.label(), ObjectFreedom::Free);
    return moved.optimiseObjects().initialCost;
  };
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  double moves = 0, turns = 0;  // second derivatives, summed over the axes
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d d = kStep * Eigen::Vector3d::Unit(i);
    const double twice = 2 * costAt(none, none);
    moves += (costAt(d, none) + costAt(-d, none) - twice) / (kStep * kStep);
    turns += (costAt(none, d) + costAt(none, -d) - twice) / (kStep * kStep);
  }
  EXPECT_NEAR(edges[0].positionInformation / (moves / 3), 1, 1e-4);
  EXPECT_NEAR(edges[0].angleInformation / (turns / 3), 1, 1e-3);
}
