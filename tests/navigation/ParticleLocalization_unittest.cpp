#include "quadmap/navigation/ParticleLocalization.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../base/OptionGroupLaws.h"
#include "../maps/ObjectMapFixture.h"
#include "quadmap/geometry/PosePosition.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** A room without symmetry, and a map of it. */
class MappedWorld : public ::testing::Test
{
 protected:
  static std::vector<TrueObject> world()
  {
    auto objects = kitchen();
    objects.push_back(cuboid("tv", {2.2, 1.5, 1.0}, {0.2, 0.9, 0.6}, 0.0));
    objects.push_back(cuboid("bed", {-2.4, 1.8, 0.3}, {2.0, 1.5, 0.6}, 0.2));
    return objects;
  }

  static const CQuadricObjectMap& map()
  {
    static const CQuadricObjectMap made = []
    {
      CQuadricObjectMap map;
      SyntheticCamera camera(1);
      walkAround(map, camera, world(), 60, {0, 0.5, 0.5}, 3.2);
      map.consolidate();
      return map;
    }();
    return made;
  }

  /** The map after the turn and shift that take one pose to another. */
  static CQuadricObjectMap mapMoved(const LevelPose& from, const LevelPose& to)
  {
    const double yaw = to.yaw - from.yaw;
    UprightCovariance J = UprightCovariance::Identity();
    J.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(yaw).toRotationMatrix();
    CQuadricObjectMap moved;
    moved.likelihoodOptions = map().likelihoodOptions;
    for (const auto& [id, object] : map().objects())
    {
      MapObject copy = object;
      UprightState x = uprightStateOf(object.object);
      const Eigen::Vector3d off = x.head<3>() - from.position;
      x.head<3>() = to.position + J.topLeftCorner<3, 3>() * off;
      x[3] += yaw;
      copy.object = ellipsoidOf(x);
      copy.covariance = J * object.covariance * J.transpose();
      moved.addObject(copy);
    }
    return moved;
  }

  /** The way of a robot that drives around, looking at the middle. */
  static CPose3D robotAt(int i) { return poseAround(i + 7, 80, {0, 0.3, 0.5}, 2.9, 1.4); }

  /** Lets a filter follow the robot over some frames.
   * \param afterUpdate Called with the number of the frame. */
  template <typename F>
  static ParticleLocalization localised(
      const LocalizationOptions& options, int frames, std::size_t threads, const F& afterUpdate)
  {
    SyntheticCamera camera(5);
    camera.disturbances.missProbability = 0.1;
    camera.disturbances.flipProbability = 0.03;
    ParticleLocalization filter(options, regionOf(map(), options.startMargin), robotAt(0), threads);
    const PoseUncertaintyOptions uncertainty;
    for (int i = 0; i < frames; ++i)
    {
      if (i > 0) filter.predict(odometryStep(uncertainty, robotAt(i - 1), robotAt(i)), robotAt(i));
      filter.update(map().likelihoodOf(camera.observe(robotAt(i), world()), robotAt(i)));
      afterUpdate(i, filter);
    }
    return filter;
  }

  static void expectNear(const CPose3D& found, const CPose3D& truth)
  {
    EXPECT_LT(std::hypot(found.x() - truth.x(), found.y() - truth.y()), 0.15) << "[m]";
    EXPECT_LT(std::abs(mrpt::math::wrapToPi(found.yaw() - truth.yaw())), mrpt::DEG2RAD(5.0));
  }
};

}  // namespace

TEST_F(MappedWorld, IsFoundFromAnywhere)
{
  for (const int seed : {1, 2, 3})
  {
    LocalizationOptions options;
    options.seed = seed;
    const auto filter = localised(options, 25, 1, [](int, const auto&) {});
    EXPECT_TRUE(filter.estimate().isLocalised) << seed;
    expectNear(filter.estimate().T_map_robot, robotAt(24));
  }
}

TEST_F(MappedWorld, IsLostBeforeAnythingWasSeen)
{
  const LocalizationOptions options;
  const ParticleLocalization filter(options, regionOf(map(), 1), {});
  EXPECT_FALSE(filter.estimate().isLocalised);
  EXPECT_LT(filter.estimate().share, 0.1);
}

TEST_F(MappedWorld, NeedsWhatIsSeenToBeFoundAmongFewParticles)
{
  // Without poses that are drawn from what is seen, 100 poses miss the place in 40 m^2. One draw
  // of so few may do well or badly by its last digits, so many draws are counted.
  constexpr int kDraws = 40;
  const auto found = [](LocalizationOptions options)
  {
    int n = 0;
    for (int seed = 1; seed <= kDraws; ++seed)
    {
      options.seed = seed;
      const CPose3D T = localised(options, 8, 1, [](int, const auto&) {}).estimate().T_map_robot;
      if ((positionOf(T) - positionOf(robotAt(7))).norm() < 0.5) ++n;
    }
    return n;
  };
  LocalizationOptions options;
  options.particles = 100;
  EXPECT_GT(found(options), 0.7 * kDraws);  // 35 do
  options.searchShare = options.doubtShare = 0;
  EXPECT_LT(found(options), 0.4 * kDraws);  // 5 do
}

TEST_F(MappedWorld, IsFoundAgainAfterItWasCarriedAway)
{
  const LocalizationOptions options;
  SyntheticCamera camera(6);
  ParticleLocalization filter(options, regionOf(map(), 1), robotAt(0));
  const PoseUncertaintyOptions uncertainty;
  for (int i = 0; i < 60; ++i)
  {
    const int at = i < 25 ? i : i + 35;  // carried on without odometry
    if (i > 0 && i != 25)
      filter.predict(odometryStep(uncertainty, robotAt(at - 1), robotAt(at)), robotAt(at));
    filter.update(map().likelihoodOf(camera.observe(robotAt(at), world()), robotAt(at)));
    if (i == 24) expectNear(filter.estimate().T_map_robot, robotAt(at));
  }
  expectNear(filter.estimate().T_map_robot, robotAt(94));
}

TEST_F(MappedWorld, GivesTheSameNumbersWithAnyNumberOfThreads)
{
  const LocalizationOptions options;
  std::vector<std::vector<double>> runs;
  for (const std::size_t threads : {1u, 3u})
  {
    runs.emplace_back();
    localised(
        options, 6, threads,
        [&](int, const ParticleLocalization& filter)
        {
          for (const LevelPose& p : filter.particles())
          {
            runs.back().push_back(p.position.x());
            runs.back().push_back(p.yaw);
          }
          runs.back().push_back(filter.estimate().share);
        });
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST_F(MappedWorld, AFrameIsComparedFromAnyPoseAsWithAMapThatIsMovedInstead)
{
  SyntheticCamera camera(9);
  camera.disturbances.partialProbability = 0.4;
  const CPose3D T = robotAt(3);
  const LevelPose there{positionOf(T), T.yaw()};
  const auto boxes = camera.observe(T, world());
  const auto seen = map().likelihoodOf(boxes, T);
  for (const double yaw : {0.0, 0.1, 2.0})
    for (const double x : {0.0, 0.2, -1.0})
    {
      const LevelPose at{there.position + Eigen::Vector3d(x, 0.5 * x, -0.1 * x), there.yaw + yaw};
      EXPECT_NEAR(seen.at(at), mapMoved(at, there).likelihoodOf(boxes, T).at(there), 1e-6)
          << yaw << " rad, " << x << " m";
    }
}

TEST_F(MappedWorld, ACompleteBoxAgreesAsTheMathematicsSays)
{
  SyntheticCamera camera(9);
  const CPose3D T = robotAt(3);
  auto boxes = camera.observe(T, world());
  const DetectedObject box = boxes.objects.front();
  ASSERT_TRUE(box.measurement.complete);
  boxes.objects = {box};
  const auto seen = map().likelihoodOf(boxes, T);
  ASSERT_EQ(seen.boxes().size(), 1u);
  const ObjectView& view = seen.boxes().front().view;
  const LikelihoodOptions& options = map().likelihoodOptions;
  for (const double yaw : {0.0, 0.05, 0.3})
  {
    const CPose3D at(T.x() + 0.1, T.y(), T.z(), T.yaw() + yaw, T.pitch(), T.roll());
    const auto cuboid = box.measurement.complete->object_sensor.transformed(at + boxes.sensorPose);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(at.yaw(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    double explained = 0;
    for (const auto& pairing : seen.pairings())
    {
      const auto& target = seen.targets()[pairing.target];
      const Eigen::Vector3d d = cuboid.center() - target.object.center();
      const Eigen::Matrix3d S = R * view.centerCovariance * R.transpose() + target.covariance +
                                std::pow(options.positionSigma, 2) * Eigen::Matrix3d::Identity();
      double chi2 = d.dot(S.inverse() * d);
      if (view.yawDefined && target.orientationDefined)
      {
        // Distance of angles that mean the same every 90 degrees.
        const double off = std::asin(std::sin(2 * (view.yaw + at.yaw() - target.yaw))) / 2;
        chi2 += off * off /
                (view.yawSigma * view.yawSigma + target.yawVariance +
                 options.yawSigma * options.yawSigma);
      }
      explained += pairing.agreement * std::exp(-0.5 * chi2);  // (14.2)
    }
    const double e = options.outlierShare;
    EXPECT_NEAR(
        seen.at({positionOf(at), at.yaw()}),
        std::log(e + (1 - e) * std::min(1.0, explained)),  // (14.1)
        1e-6)
        << yaw << " rad";
  }
}

TEST_F(MappedWorld, AFalseBoxCostsNoMoreThanTheShareOfOutliersSays)
{
  SyntheticCamera camera(9);
  const CPose3D T = robotAt(3);
  auto boxes = camera.observe(T, world());
  const LevelPose truth{
      {T.x(), T.y(), T.z()},
      T.yaw()
  };
  const double before = map().likelihoodOf(boxes, T).at(truth);
  auto moved = boxes.objects.front();
  ASSERT_TRUE(moved.measurement.complete);
  auto& cuboid = moved.measurement.complete->object_sensor;
  cuboid = Ellipsoid(cuboid.pose() + CPose3D(30, 0, 0, 0, 0, 0), cuboid.semiAxes());
  moved.box = {0, 0, 30, 30};
  boxes.objects.push_back(moved);
  const double after = map().likelihoodOf(boxes, T).at(truth);
  EXPECT_NEAR(after - before, std::log(map().likelihoodOptions.outlierShare), 1e-9);
}

TEST(LocalizationRegion, HoldsTheObjectsAndAMargin)
{
  const CQuadricObjectMap map = smallMap();
  const StartRegion region = regionOf(map, 0.5);
  EXPECT_NEAR(region.upper.y(), map.boundingBox().max.y + 0.5, 1e-6);
  EXPECT_NEAR(region.lower.x(), map.boundingBox().min.x - 0.5, 1e-6);
  EXPECT_THROW(regionOf(CQuadricObjectMap(), 1), std::invalid_argument);
}

TEST(LocalizationOptions, KeepTheLawsOfOptions) { expectLaws<LocalizationOptions>("localization"); }
