#include "visual/MotionEstimator.h"

#include <gtest/gtest.h>

#include <random>

#include "../../sensors/SampleRawlog.h"
#include "quadmap/obs/CObservationObjects.h"

using namespace quadmap;

namespace
{
const Eigen::Isometry3d kT_to_from =
    isometryOf(mrpt::poses::CPose3D(0.08, -0.05, 0.1, 0.06, -0.04, 0.05));

/** An image with a camera but no depth, so that only correspondences count. */
mrpt::obs::CObservation3DRangeScan::Ptr emptyScan()
{
  auto scan = sampleScan(kStart);
  scan->cameraParams.ncols = 320;
  scan->cameraParams.nrows = 240;
  scan->cameraParams.setIntrinsicParamsFromValues(260, 260, 159.5, 119.5);
  scan->hasIntensityImage = false;
  scan->rangeImage_setSize(240, 320);
  scan->rangeImage.setZero();
  return scan;
}

/** Points all over the image of the first camera, with their pixels in the second. */
std::vector<Correspondence> correspondencesOf(const PinholeCamera& camera, int count)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(20, 300), v(20, 220), z(0.8, 3);
  std::vector<Correspondence> result;
  while (static_cast<int>(result.size()) < count)
  {
    const Eigen::Vector3d point = z(random) * camera.ray(u(random), v(random));
    const Eigen::Vector3d there = kT_to_from * point;
    result.push_back({point, camera.project(there), there.z()});
  }
  return result;
}

struct Views
{
  VisualOdometryOptions options;
  VisualImage image{*emptyScan(), options};
  MotionEstimator estimator{options};
};
}  // namespace

TEST(MotionEstimator, FindsTheMotionAmongWrongMatches)
{
  const Views views;
  auto correspondences = correspondencesOf(views.image.camera(), 200);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 319), v(0, 239);
  for (std::size_t i = 0; i < correspondences.size(); i += 2)
    correspondences[i].pixel_to = {u(random), v(random)};
  const auto rough = views.estimator.consensus(correspondences, views.image.camera(), 25, 2000);
  ASSERT_TRUE(rough);
  EXPECT_GE(correspondences.size(), 100u);
  EXPECT_LT(correspondences.size(), 110u) << "hardly a wrong one agrees";
  const auto estimate = views.estimator.refine(correspondences, {}, views.image, *rough, 0.5);
  ASSERT_TRUE(estimate);
  const Eigen::Isometry3d error = estimate->T_to_from * kT_to_from.inverse();
  EXPECT_LT(error.translation().norm(), 2e-3);
  EXPECT_LT(angleOf(error), 1e-3);
  EXPECT_GE(estimate->inliers, 100);
}

TEST(MotionEstimator, NothingAgreesOnNoise)
{
  const Views views;
  auto correspondences = correspondencesOf(views.image.camera(), 200);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 319), v(0, 239);
  for (auto& c : correspondences) c.pixel_to = {u(random), v(random)};
  EXPECT_FALSE(views.estimator.consensus(correspondences, views.image.camera(), 25, 300));
}

TEST(MotionEstimator, IsExactWithoutNoise)
{
  const Views views;
  const auto correspondences = correspondencesOf(views.image.camera(), 60);
  const auto near = smallMotion(0.01 * Vector6::Ones()) * kT_to_from;  // as RANSAC finds it
  const auto estimate = views.estimator.refine(correspondences, {}, views.image, near, 0.5);
  ASSERT_TRUE(estimate);
  EXPECT_LT((estimate->T_to_from.matrix() - kT_to_from.matrix()).norm(), 1e-6);
  EXPECT_EQ(estimate->inliers, 60);
}

TEST(MotionEstimator, CovarianceIsTheSampledOneTimesItsMargin)
{
  const Views views;
  const auto exact = correspondencesOf(views.image.camera(), 150);
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  Matrix6 sum = Matrix6::Zero(), stated = Matrix6::Zero();
  constexpr int kSamples = 400;
  for (int n = 0; n < kSamples; ++n)
  {
    auto noisy = exact;
    for (auto& c : noisy)
    {
      c.pixel_to += 0.5 * Eigen::Vector2d(normal(random), normal(random));
      c.depth_to += 0.004 * normal(random);
    }
    const auto estimate = views.estimator.refine(noisy, {}, views.image, kT_to_from, 0.5);
    ASSERT_TRUE(estimate);
    const Eigen::Isometry3d error = estimate->T_to_from * kT_to_from.inverse();
    Vector6 x;
    const Eigen::AngleAxisd turn(error.linear());
    x << error.translation(), turn.angle() * turn.axis();
    sum += x * x.transpose();
    stated += estimate->covariance;
  }
  // The margin is 6 in variance; Cauchy weights at 2 sigma take a third off the residual variance
  // of Gaussian noise: 4. 400 samples give variances to 7 %.
  for (int i = 0; i < 6; ++i)
  {
    const double ratio = stated(i, i) / sum(i, i);
    EXPECT_GT(ratio, 3) << "coordinate " << i;
    EXPECT_LT(ratio, 5.5) << "coordinate " << i;
  }
}

TEST(MotionEstimator, SurfacesAloneDoWhenTheyFaceThreeWays)
{
  // Three walls that meet in a corner, 2 m ahead; the camera moves by 3 cm and one degree.
  const Eigen::Vector3d corner(0.1, 0.05, 2.2);
  const Eigen::Vector3d normals[] = {
      Eigen::Vector3d(-0.6, 0.2, -0.8).normalized(), Eigen::Vector3d(0.7, 0.3, -0.6).normalized(),
      Eigen::Vector3d(0.1, -0.8, -0.6).normalized()};
  const auto T = isometryOf(mrpt::poses::CPose3D(0.02, -0.01, 0.02, 0.01, 0.012, -0.01));
  const auto scanFrom = [&](const Eigen::Isometry3d& T_to_world)
  {
    auto scan = emptyScan();
    const PinholeCamera camera = pinholeFrom(scan->cameraParams);
    const Eigen::Isometry3d T_world_to = T_to_world.inverse();
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u)
      {
        const Eigen::Vector3d ray = T_world_to.linear() * camera.ray(u, v);
        double nearest = 1e9;
        for (const auto& n : normals)
        {
          const double z = n.dot(corner - T_world_to.translation()) / n.dot(ray);
          if (z > 0) nearest = std::min(nearest, z);
        }
        scan->rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(1000 * nearest));
      }
    return scan;
  };
  const VisualOdometryOptions options;
  const VisualImage from(*scanFrom(Eigen::Isometry3d::Identity()), options);
  const VisualImage to(*scanFrom(T), options);
  const auto estimate = MotionEstimator(options).refine(
      {}, sampleSurface(from), to, Eigen::Isometry3d::Identity(), 0.5);
  ASSERT_TRUE(estimate);
  const Eigen::Isometry3d error = estimate->T_to_from * T.inverse();
  EXPECT_LT(error.translation().norm(), 0.002) << "[m], depths are rounded to 1 mm";
  EXPECT_LT(angleOf(error), 0.001);
  EXPECT_GT(estimate->surfaceShare, 0.9);
}
