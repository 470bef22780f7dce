#include "quadmap/perception/BoxEdges.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace quadmap;

namespace
{
/** An image 320 px wide: its border rule is 15 px. */
CObservationObjects imageWith(const std::vector<ImageBox>& boxes)
{
  CObservationObjects image;
  image.cameraParams.ncols = 320;
  image.cameraParams.nrows = 240;
  image.cameraParams.setIntrinsicParamsFromValues(260, 250, 159.5, 119.5);
  for (const auto& box : boxes)
  {
    image.objects.emplace_back();
    image.objects.back().label = "chair";
    image.objects.back().box = box;
  }
  return image;
}

}  // namespace

TEST(BoxEdges, AreUsableAwayFromTheBorder)
{
  auto image = imageWith({
      {100, 80, 180, 160},
      { 10, 80, 180, 230},
      { 40, 14, 306, 200}
  });
  measureWithoutDepth(image, PerceptionOptions());
  using State = EdgeState;
  const State u = State::Usable, b = State::NearImageBorder;
  const State expected[3][4] = {
      {u, u, u, u},
      {b, u, u, b},
      {u, b, b, u}
  };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto& m = image.objects[k].measurement;
    EXPECT_EQ(m.kind, MeasurementKind::Partial);
    EXPECT_FALSE(m.seed_sensor || m.complete) << "these would need depth";
    for (std::size_t e = 0; e < 4; ++e) EXPECT_EQ((*m.edges)[e].state, expected[k][e]) << k << e;
  }
}

TEST(BoxEdges, ArePlanesThroughCameraAndEdge)
{
  auto image = imageWith({
      {100, 80, 180, 140}
  });
  PerceptionOptions options;
  options.edgeSigma = 2.0;
  options.edgeSigmaShare = 0.015;
  measureWithoutDepth(image, options);
  const auto& edges = *image.objects[0].measurement.edges;
  const PinholeCamera camera = pinholeFrom(image.cameraParams);
  const auto inSensor = [&](double u, double v)
  {
    const Eigen::Vector3d p = camera.ray(u, v);
    return Eigen::Vector3d(p.z(), -p.x(), -p.y());
  };
  const Eigen::Vector3d points[] = {
      inSensor(100, 130), inSensor(130, 80), inSensor(180, 90), inSensor(120, 140)};
  for (std::size_t e = 0; e < 4; ++e)
  {
    EXPECT_NEAR(edges[e].plane_sensor.signedDistance(points[e]), 0, 1e-9) << e;
    EXPECT_NEAR(edges[e].plane_sensor.d, 0, 1e-12) << e;
    EXPECT_GT(edges[e].plane_sensor.signedDistance(inSensor(140, 120)), 0) << "inwards, " << e;
    // 2 px of 640 are one of 320; 1.5 % of the width or of the height.
    const double sigma = e % 2 == 0 ? (1 + 0.015 * 80) / 260 : (1 + 0.015 * 60) / 250;
    EXPECT_NEAR(edges[e].sigmaAngle, sigma, 1e-12) << e;
  }
}

TEST(BoxEdges, RejectsWhatShowsNoEdge)
{
  auto image = imageWith({
      {  2,   3, 318, 238},
      {400, 300, 500, 380},
      {100,  80,  90, 160}
  });
  measureWithoutDepth(image, PerceptionOptions());
  for (const auto& object : image.objects)
  {
    EXPECT_EQ(object.measurement.kind, MeasurementKind::Rejected);
    EXPECT_FALSE(object.measurement.reason.empty());
    EXPECT_FALSE(object.measurement.edges);
  }
}

TEST(BoxEdges, WithoutTheBorderRuleThoseAtTheBorderCountToo)
{
  auto image = imageWith({
      {200, 100, 320, 160}
  });
  PerceptionOptions options;
  measureWithoutDepth(image, options);
  EXPECT_EQ((*image.objects[0].measurement.edges)[2].state, EdgeState::NearImageBorder);
  options.borderMargin = 0;
  measureWithoutDepth(image, options);
  EXPECT_EQ((*image.objects[0].measurement.edges)[2].state, EdgeState::Usable);
}

TEST(BoxEdges, NeedACalibration)
{
  auto image = imageWith({});
  const auto camera = image.cameraParams;
  EXPECT_NO_THROW(measureWithoutDepth(image, PerceptionOptions()));
  image.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_THROW(measureWithoutDepth(image, PerceptionOptions()), std::runtime_error);
  image.cameraParams = camera;
  image.cameraParams.cx(std::nan(""));
  EXPECT_THROW(measureWithoutDepth(image, PerceptionOptions()), std::runtime_error);
}
