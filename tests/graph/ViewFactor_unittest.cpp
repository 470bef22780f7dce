#include <random>

#include "../maps/SyntheticScene.h"
#include "FactorCheck.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
const CPose3D kRobotToSensor(0.1, -0.05, 1.2, 0.2, 0.3, -0.02);
const TrueObject kCabinet = cuboid("suitcase", {1.5, 0.4, 0.28}, {0.78, 0.43, 0.56}, 0.3);
constexpr double kTilt = 0.02;  // [rad]

LabelProperties boxy()
{
  LabelProperties p;
  p.name = "suitcase";
  p.typicalSize = {0.6, 0.6, 0.6};
  p.sizeSpread = 0.6;
  return p;
}

/** A measurement with the robot's pose it was made from, and as the object map has it. */
struct Sample
{
  CPose3D T_map_robot;
  ObjectView inMap;
  BoxMeasurement view;
};

std::vector<Sample> samples(double partialShare, int count)
{
  SyntheticCamera camera(3);
  camera.disturbances.partialProbability = partialShare;
  camera.disturbances.boxSigma = 6;
  std::vector<Sample> result;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * M_PI * i / count;
    const Eigen::Vector3d eye =
        kCabinet.object.center() + Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 1.0);
    const auto T_map_sensor = SyntheticCamera::lookAt(eye, kCabinet.object.center());
    const CPose3D T_map_robot = camera.disturbed(T_map_sensor) + (-kRobotToSensor);
    for (const auto& d : camera.observe(T_map_sensor, {kCabinet}).objects)
      if (const auto v = viewOf(d, T_map_robot + kRobotToSensor, boxy(), PoseNoise()))
        result.push_back(
            {T_map_robot, *v, measurementFromRobot(d, *v, T_map_robot, kRobotToSensor, {}, kTilt)});
  }
  return result;
}

/** Near the truth, turned and leaning when free. */
Ellipsoid guess(ObjectFreedom freedom)
{
  const bool free = freedom == ObjectFreedom::Free;
  return {
      CPose3D(1.45, 0.43, 0.26, 0.36, free ? 0.06 : 0, free ? -0.04 : 0), {0.41, 0.2, 0.3}
  };
}

}  // namespace

TEST(ViewFactor, DerivativesAreThoseOfTheResiduals)
{
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
    for (const double huber : {kQuadratic, 1.5})
      for (const double q : {1.05, 1.5, 2.0})
        for (auto sample : samples(0.4, 12))
        {
          sample.view.weight = 0.7;
          const auto factor = createViewFactor(sample.view, q, huber, freedom);
          expectRightDerivatives(
              *factor, {poseBlock(sample.T_map_robot), objectBlock(guess(freedom), freedom)});
        }
}

TEST(ViewFactor, AgreesWithTheObjectMapAtFixedPoses)
{
  // Cost and gradient by the object's state are those the map's estimator minimises. The seed's
  // residuals are whitened along other axes: they agree where Huber's kernel does not act.
  std::size_t count = 0;
  for (const double partialShare : {0.0, 1.0})
    for (auto& sample : samples(partialShare, 12))
    {
      EstimatorOptions options;
      options.huber = partialShare > 0 ? kQuadratic : 1.5;
      auto& view = sample.view;
      // Every other one without a heading: its faces then touch another surface of the family.
      view.faceExponent = sample.inMap.faceExponent = ++count % 2 == 0 ? 2.0 : 1.3;
      view.weight = 0.6;
      view.tiltSigma = 0;  // says nothing of the object
      const auto factor = createViewFactor(view, 1.3, options.huber, ObjectFreedom::Upright);
      const UprightState x = uprightStateOf(guess(ObjectFreedom::Upright));
      const std::vector<Block> blocks{
          poseBlock(sample.T_map_robot),
          objectBlock(guess(ObjectFreedom::Upright), ObjectFreedom::Upright)};
      NormalEquations eq;
      addViewResiduals(sample.inMap, x, 1.3, options, 0.6, eq);

      const Eigen::VectorXd r = residualsOf(*factor, blocks);
      EXPECT_NEAR(0.5 * r.squaredNorm(), eq.cost, 1e-9 * (1 + eq.cost));
      const Eigen::VectorXd g = jacobiansOf(*factor, blocks)[1].transpose() * r;
      EXPECT_LT((g - eq.g).norm(), 1e-8 * (1 + eq.g.norm()));
    }
}

TEST(ViewFactor, FacesAreTheGapToTheSampledSurface)
{
  // r of a face = where its plane is, minus how far out the object's surface reaches.
  for (auto sample : samples(0, 6))
  {
    BoxMeasurement& view = sample.view;
    view.edges.clear();
    view.yawDefined = false;
    view.tiltSigma = 0;
    for (auto& face : view.faces) face = {FaceKind::Measured, 0.02};
    const Ellipsoid object = guess(ObjectFreedom::Upright);
    const auto factor = createViewFactor(view, 1.3, kQuadratic, ObjectFreedom::Upright);
    const Eigen::VectorXd r = residualsOf(
        *factor, {poseBlock(sample.T_map_robot), objectBlock(object, ObjectFreedom::Upright)});
    ASSERT_EQ(r.size(), 6);
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      const Eigen::Vector3d n = sample.inMap.faceNormal(f);
      double reach = -1e9;
      constexpr int kSteps = 400;
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j < 2 * kSteps; ++j)
        {
          const double theta = M_PI * i / kSteps, phi = M_PI * j / kSteps;
          const Eigen::Vector3d unit(
              std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
          const Eigen::Vector3d p =
              object.center() + object.rotation() * object.semiAxes().cwiseProduct(unit);
          reach = std::max(reach, n.dot(p));
        }
      EXPECT_NEAR(r[static_cast<Eigen::Index>(f)] * 0.02, sample.inMap.faceOffset(f) - reach, 1e-4);
    }
  }
}

TEST(ViewFactor, ResidualsVanishAtTheTruthWithoutNoise)
{
  SyntheticCamera camera(5);
  auto& wrong = camera.disturbances;
  wrong.faceSigma = wrong.yawSigma = wrong.boxSigma = 0;
  const auto T_map_sensor = SyntheticCamera::lookAt({-0.6, -0.4, 1.3}, kCabinet.object.center());
  const CPose3D T_map_robot = T_map_sensor + (-kRobotToSensor);
  const auto obs = camera.observe(T_map_sensor, {kCabinet});
  ASSERT_EQ(obs.objects.size(), 1u);
  EstimatorOptions options;
  options.edgesOfComplete = true;
  const auto inMap = viewOf(obs.objects[0], T_map_sensor, boxy(), PoseNoise());
  const auto view =
      measurementFromRobot(obs.objects[0], *inMap, T_map_robot, kRobotToSensor, options, kTilt);
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
  {
    const auto factor = createViewFactor(view, 1.0, 1.5, freedom);
    const Eigen::VectorXd r =
        residualsOf(*factor, {poseBlock(T_map_robot), objectBlock(kCabinet.object, freedom)});
    EXPECT_GE(r.size(), 8);
    // The cuboid's corners are rounded by the smoothing of h_1: a millimetre.
    EXPECT_LT(r.cwiseAbs().maxCoeff(), 0.1) << r.transpose();
  }
}

TEST(ViewFactor, AFreeObjectLeansAsMeasured)
{
  // Of a free object the turn is compared in all three angles, whatever its axes are called.
  BoxMeasurement view;
  view.complete = view.yawDefined = true;
  view.yawSigma = 0.05;
  view.tiltSigma = 0.02;
  view.center = {2, 0, 0.5};
  view.axes = (rotationOf({0.1, 0.2, 0.3}) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()))
                  .toRotationMatrix();
  const Eigen::Vector3d lean(0.02, -0.03, 0.04);  // [rad], about the axes of the map
  const CPose3D pose(1, 1, 0, 0, 0, 0);
  const Eigen::Matrix3d R = rotationOf(lean).toRotationMatrix() * view.axes;
  const Ellipsoid object(
      CPose3D(mrpt::math::CMatrixDouble33(R), mrpt::math::TPoint3D(3, 1, 0.5)), {0.3, 0.4, 0.5});
  const auto factor = createViewFactor(view, 1.3, kQuadratic, ObjectFreedom::Free);
  const Eigen::VectorXd r =
      residualsOf(*factor, {poseBlock(pose), objectBlock(object, ObjectFreedom::Free)});
  ASSERT_EQ(r.size(), 3);
  EXPECT_NEAR(r[0] * 0.02, view.axes.col(0).dot(lean), 1e-9);
  EXPECT_NEAR(r[1] * 0.02, view.axes.col(1).dot(lean), 1e-9);
  EXPECT_NEAR(r[2] * 0.05, view.axes.col(2).dot(lean), 1e-9);
}
