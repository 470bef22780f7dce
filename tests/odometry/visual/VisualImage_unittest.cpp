#include "visual/VisualImage.h"

#include <gtest/gtest.h>

#include "../../sensors/SampleRawlog.h"
#include "quadmap/obs/CObservationObjects.h"
#include "visual/RigidMotion.h"

using namespace quadmap;

namespace
{
/** A sloping plane n.x = d in `optical` of the depth camera, whose image has 640x480 pixels. */
const Eigen::Vector3d kNormal = Eigen::Vector3d(0.3, -0.2, 1).normalized();
constexpr double kDistance = 2.0;  // [m]

mrpt::obs::CObservation3DRangeScan::Ptr planeScan()
{
  auto scan = sampleScan(kStart);
  auto& camera = scan->cameraParams;
  camera.ncols = 640;
  camera.nrows = 480;
  camera.setIntrinsicParamsFromValues(570, 571, 315, 243);
  scan->cameraParamsIntensity = camera;
  scan->rangeImage_setSize(480, 640);
  scan->intensityImage.resize(640, 480, mrpt::img::CH_GRAY);
  const PinholeCamera pinhole = pinholeFrom(camera);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
    {
      const double z = kDistance / kNormal.dot(pinhole.ray(u, v));
      scan->rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(1000 * z));
      scan->intensityImage.at<std::uint8_t>(u, v) = static_cast<std::uint8_t>(u % 256);
    }
  return scan;
}

/** Largest distance of the image's points from the plane [m], and number of pixels with depth. */
std::pair<double, int> offPlane(const VisualImage& image, const Eigen::Isometry3d& T_depth_image)
{
  double worst = 0;
  int count = 0;
  for (int v = 0; v < image.rows(); ++v)
    for (int u = 0; u < image.columns(); ++u)
    {
      const double z = image.depth(u, v);
      if (z <= 0) continue;
      ++count;
      const Eigen::Vector3d p = T_depth_image * image.point(u, v, z);
      worst = std::max(worst, std::abs(kNormal.dot(p) - kDistance));
    }
  return {worst, count};
}
}  // namespace

TEST(VisualImage, HalvesTheCameraAndKeepsTheGeometry)
{
  const VisualImage image(*planeScan(), {});
  EXPECT_EQ(image.columns(), 320);
  EXPECT_EQ(image.rows(), 240);
  EXPECT_EQ(image.gray().cols, 320);
  const auto [worst, count] = offPlane(image, Eigen::Isometry3d::Identity());
  EXPECT_LT(worst, 0.002) << "depths are rounded to 1 mm";
  EXPECT_EQ(count, 320 * 240);
  EXPECT_NEAR(
      image.depthAt(100.5, 80.25), kDistance / kNormal.dot(image.camera().ray(100.5, 80.25)),
      0.002);
}

TEST(VisualImage, BringsDepthIntoAColourCameraElsewhere)
{
  auto scan = planeScan();
  const mrpt::poses::CPose3D T_optical_colour(0.025, 0.003, -0.004, 0.01, 0.02, -0.01);
  scan->relativePoseIntensityWRTDepth = T_sensor_optical() + T_optical_colour;
  scan->cameraParamsIntensity.setIntrinsicParamsFromValues(520, 522, 322, 238);
  scan->sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 1, 0.3, 0, 0);
  const VisualImage image(*scan, {});
  EXPECT_NEAR(image.camera().fx, 260, 1e-9);
  // A depth is that of a neighbour up to half a pixel (4 mm at 2 m) away, on a slope of 0.35
  const auto [worst, count] = offPlane(image, isometryOf(T_optical_colour));
  EXPECT_LT(worst, 0.003);
  // The colour camera sees more than the depth camera, by the square of 570 to 520
  EXPECT_GT(count, 0.8 * 320 * 240);
  const auto T_robot_colour = scan->sensorPose + scan->relativePoseIntensityWRTDepth;
  EXPECT_LT((image.T_robot_optical().matrix() - isometryOf(T_robot_colour).matrix()).norm(), 1e-9);
}

TEST(VisualImage, TakesTheDepthCameraWithoutAColourImage)
{
  auto scan = planeScan();
  scan->hasIntensityImage = false;
  scan->relativePoseIntensityWRTDepth.x(0.5);
  const VisualImage image(*scan, {});
  EXPECT_TRUE(image.gray().empty());
  EXPECT_NEAR(image.camera().fx, 285, 1e-9);
  EXPECT_EQ(offPlane(image, Eigen::Isometry3d::Identity()).second, 320 * 240);
}

TEST(VisualImage, HasNoDepthAcrossEdgesAndOutOfRange)
{
  auto scan = planeScan();
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      scan->rangeImage(v, u) = static_cast<std::uint16_t>(u < 301 ? 1000 : u < 500 ? 3000 : 9000);
  const VisualImage image(*scan, {});
  EXPECT_FLOAT_EQ(image.depth(149, 50), 1.f);
  EXPECT_EQ(image.depth(150, 50), 0.f) << "half of its pixels on either side";
  EXPECT_FLOAT_EQ(image.depth(151, 50), 3.f);
  EXPECT_EQ(image.depth(260, 50), 0.f) << "beyond maxRange";
  EXPECT_EQ(image.depthAt(149.5, 50), 0);
  EXPECT_EQ(image.depthAt(-1, 50), 0);
}
