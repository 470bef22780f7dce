#include <gtest/gtest.h>

#include <random>

#include "EstimatorFixture.h"
#include "quadmap/geometry/Projection.h"

using namespace quadmap;
using namespace quadmap::testing;

TEST(ObjectView, UnusableMeasurementsGiveNone)
{
  DetectedObject d;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise)) << "kind None";
  d.measurement.kind = MeasurementKind::Rejected;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise));
  d.measurement.kind = MeasurementKind::Partial;
  EXPECT_FALSE(viewOf(d, {}, boxy("x"), kNoise)) << "neither seed nor edges";
}

TEST(ObjectView, LeaningCuboidsAreNotUsedAsCuboids)
{
  DetectedObject d;
  d.measurement.kind = MeasurementKind::Complete;
  CompleteMeasurement c;
  c.object_sensor = Ellipsoid(mrpt::poses::CPose3D(2, 0, 0, 0, 0.6, 0), {0.2, 0.2, 0.2});
  d.measurement.complete = c;
  d.measurement.seed_sensor = Eigen::Vector3d(1.8, 0, 0);
  const auto view = viewOf(d, {}, boxy("x"), kNoise);
  ASSERT_TRUE(view);
  EXPECT_FALSE(view->complete);
}

TEST(ObjectView, WithoutDepthAThingIsOnTheRayOfItsBoxAsFarAsItsSizeSays)
{
  PinholeCamera camera;
  camera.fx = camera.fy = 525;
  camera.cx = 320;
  camera.cy = 240;
  camera.width = 640;
  camera.height = 480;
  LabelProperties label = boxy("thing");
  label.known = true;
  label.typicalSize = {0.4, 0.4, 0.5};
  label.sizeSpread = 0.3;
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(3.5, 1.5, 8), Eigen::Vector3d(-1, -0.8, 2.5)})
  {
    const Ellipsoid thing({center.x(), center.y(), center.z(), 0, 0, 0}, {0.2, 0.25, 0.2});
    const auto box = projectEllipsoidBox(camera, thing);
    ASSERT_TRUE(box);
    DetectedObject d;
    d.measurement.kind = MeasurementKind::Partial;
    d.measurement.edges.emplace();
    const auto planes = boxEdgePlanes(camera, *box);
    for (std::size_t e = 0; e < 4; ++e)
      (*d.measurement.edges)[e].plane_sensor = planes[e].transformed(T_sensor_optical());
    const auto view = viewOf(d, {}, label, kNoise);
    ASSERT_TRUE(view);
    const Eigen::Vector3d p_optical(-view->center.y(), -view->center.z(), view->center.x());
    EXPECT_LT((p_optical.normalized() - center.normalized()).norm(), 0.003) << center.transpose();
    EXPECT_NEAR(p_optical.norm(), center.norm(), 0.05 * center.norm());
    const Eigen::Vector3d along = view->center.normalized();
    EXPECT_NEAR(
        std::sqrt(along.dot(view->centerCovariance * along)) / view->center.norm(), 0.36, 0.02);

    label.known = false;
    EXPECT_GT((viewOf(d, {}, label, kNoise)->center).norm(), 1.0) << "no size, no range";
    label.known = true;
  }
}

TEST(ObjectView, KnowsHowFarAThingMayBeWhoseDepthIsAnotherThings)
{
  DetectedObject d;
  d.measurement.kind = MeasurementKind::Partial;
  d.measurement.seed_sensor = Eigen::Vector3d(3, 0, 0);
  const mrpt::poses::CPose3D origin;
  LabelProperties plant = boxy("plant");  // its size is known but for a factor of e^0.6
  const auto view = viewOf(d, origin, plant, kNoise);
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->wrongDepthSigma, view->center.x() * std::hypot(0.6, 0.2), 1e-9);
  plant.known = false;
  EXPECT_NEAR(viewOf(d, origin, plant, kNoise)->wrongDepthSigma, 0.48 * view->center.x(), 1e-9);

  d.measurement.kind = MeasurementKind::Complete;
  d.measurement.complete = CompleteMeasurement();
  d.measurement.complete->object_sensor = Ellipsoid(origin, {0.3, 0.3, 0.3});
  EXPECT_EQ(viewOf(d, origin, plant, kNoise)->wrongDepthSigma, 0);
}

TEST(ObjectView, ASeedErrsByThePoseAsWell)
{
  DetectedObject d;
  d.measurement.kind = MeasurementKind::Partial;
  d.measurement.seed_sensor = Eigen::Vector3d(3, 0, 0);
  const LabelProperties plant = boxy("plant");
  const PoseNoise drift{0.3, 0.1};

  std::mt19937 random(5);
  std::normal_distribution<double> moved(0, drift.position), turned(0, drift.angle);
  const Eigen::Vector3d center = viewOf(d, {}, plant, {0, 0})->center;
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i)
  {
    const Eigen::Vector3d axis(turned(random), turned(random), turned(random));
    const Eigen::Vector3d shift(moved(random), moved(random), moved(random));
    const Eigen::Vector3d error = shift + axis.cross(center);
    sampled += error * error.transpose() / kSamples;
  }
  const Eigen::Matrix3d claimed = viewOf(d, {}, plant, drift)->centerCovariance -
                                  viewOf(d, {}, plant, {0, 0})->centerCovariance;
  // The samples scatter by about 1 %.
  EXPECT_LT((claimed - sampled).norm(), 0.03 * sampled.norm()) << claimed << "\n\n" << sampled;
}
