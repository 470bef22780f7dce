#include <gtest/gtest.h>

#include "../SampleRawlog.h"

using namespace quadmap;

namespace
{
/** The same camera as of the sample, but with an image that is upside down and a y axis that points
 * up in it, as in ICL-NUIM. */
void mirror(mrpt::img::TCamera& camera)
{
  camera.setIntrinsicParamsFromValues(
      camera.fx(), -camera.fy(), camera.cx(), kRows - 1 - camera.cy());
}

mrpt::obs::CObservation3DRangeScan::Ptr mirroredScan(double time)
{
  auto scan = sampleScan(time);
  const auto original = sampleScan(time);
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
    {
      const int from = kRows - 1 - v;
      scan->rangeImage(v, u) = original->rangeImage(from, u);
      for (std::int8_t channel = 0; channel < 3; ++channel)
        scan->intensityImage.at<std::uint8_t>(u, v, channel) = static_cast<std::uint8_t>(5 * from);
    }
  mirror(scan->cameraParams);
  mirror(scan->cameraParamsIntensity);
  return scan;
}

CObservationObjects::Ptr mirroredBoxes(double time)
{
  auto boxes = sampleBoxes(time);
  mirror(boxes->cameraParams);
  for (auto& object : boxes->objects)
    object.box = {
        object.box.x1, kRows - 1 - object.box.y2, object.box.x2, kRows - 1 - object.box.y1};
  boxes->objects[0].mask = ObjectMask{
      10, 8, 2, 3, {1, 0, 0, 0, 0, 1}
  };
  return boxes;
}
}  // namespace

TEST(MirroredImages, ANegativeFyBecomesPositiveWithTheSamePointsInSpace)
{
  const TemporaryFolder folder;
  const auto path =
      writeObjects(folder.path("x.rawlog"), {mirroredScan(kStart), mirroredBoxes(kStart)});
  RawlogSource source(path, {});
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->isTurned);
  const auto original = sampleScan(kStart);
  for (const auto* camera :
       {&frame->scan->cameraParams, &frame->scan->cameraParamsIntensity,
        &frame->objects->cameraParams})
  {
    EXPECT_EQ(camera->fy(), original->cameraParams.fy());
    EXPECT_EQ(camera->cy(), original->cameraParams.cy());
  }
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
    {
      ASSERT_EQ(frame->scan->rangeImage(v, u), original->rangeImage(v, u)) << u << " " << v;
      ASSERT_NEAR(frame->scan->intensityImage.at<std::uint8_t>(u, v, 0), 5 * v, 12)
          << "JPEG changes colours a little";
    }
  const auto boxes = sampleBoxes(kStart);
  ASSERT_EQ(frame->objects->objects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(frame->objects->objects[i].box.y1, boxes->objects[i].box.y1);
    EXPECT_EQ(frame->objects->objects[i].box.y2, boxes->objects[i].box.y2);
  }
  const auto& mask = frame->objects->objects[0].mask.value();
  EXPECT_EQ(mask.y0, kRows - 8u - 3u);
  EXPECT_EQ(mask.pixels, (std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0}));
}
