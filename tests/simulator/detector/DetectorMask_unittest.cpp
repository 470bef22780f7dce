#include "detector/DetectorMask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../SceneFixture.h"
#include "quadmap/obs/PixelLabels.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
/** An image of 160 x 120 pixels. Object 0 is a disc in its middle, and object 1 is right of it. */
RenderedFrame disc(double radius)
{
  RenderedFrame frame;
  frame.camera = smallCamera();
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u)
      frame.object.push_back(std::hypot(u - 80, v - 60) <= radius ? 0 : (u > 80 ? 1 : -1));
  return frame;
}

const ImageBox kImage{0, 0, 159, 119};

TEST(NoisyMask, WithoutNoiseItIsWhatIsVisibleInTheBox)
{
  const RenderedFrame frame = disc(30);
  RandomStream random(1, Purpose::Mask, 0);
  const ImageBox box{60, 40, 159, 70};
  const auto mask = noisyMask(frame, 0, box, 0, random);
  ASSERT_TRUE(mask);
  for (unsigned v = 0; v < 120; ++v)
    for (unsigned u = 0; u < 160; ++u)
      EXPECT_EQ(
          frame.object[v * 160 + u] == 0 && u >= 60 && v >= 40 && v <= 70, mask->contains(u, v));
  EXPECT_FALSE(noisyMask(frame, 0, {0, 0, 20, 20}, 0, random)) << "none of it is there";
}

TEST(NoisyMask, BorderWandersByItsSigmaAndSmoothly)
{
  const RenderedFrame frame = disc(30);
  std::vector<double> radii, steps;
  for (std::uint64_t i = 0; i < 60; ++i)
  {
    RandomStream random(1, Purpose::Mask, i);
    const auto mask = noisyMask(frame, 0, kImage, 2, random);
    ASSERT_TRUE(mask);
    double last = 0;
    for (int k = 0; k < 72; ++k)
    {
      const double angle = 2 * M_PI * k / 72;
      double r = 0;
      const auto inside = [&](double radius)
      {
        return mask->contains(
            static_cast<unsigned>(std::lround(80 + radius * std::cos(angle))),
            static_cast<unsigned>(std::lround(60 + radius * std::sin(angle))));
      };
      while (r < 55 && inside(r)) r += 0.25;
      radii.push_back(r);
      if (k > 0) steps.push_back(r - last);
      last = r;
    }
  }
  // Pixels add half a pixel; the folds of a large shift a little more.
  EXPECT_NEAR(30, momentsOf(radii).mean, 0.7);
  EXPECT_NEAR(2, momentsOf(radii).deviation, 0.5);
  EXPECT_LT(momentsOf(steps).deviation, 0.75 * std::sqrt(2) * momentsOf(radii).deviation)
      << "2.6 px farther along the border the error is nearly the same";
}

/** A small home whose detector finds everything that is visible. */
Scene faultlessHome(DetectorOutput output)
{
  Scene scene = homeScene();
  scene.options.resize(160, 120);
  scene.options.trajectory.frames = 8;
  scene.options.scaleNoise(0);
  scene.options.detector.output = output;
  return scene;
}

TEST(Simulator, GivesMasksWithBoxes)
{
  const Simulator simulator(faultlessHome(DetectorOutput::Masks), LabelTable::installed(), 1);
  std::size_t boxes = 0;
  for (std::size_t i = 0; i < simulator.frameCount(); ++i)
  {
    const auto frame = simulator.frame(i);
    EXPECT_FALSE(frame.scan->hasPixelLabels());
    for (const auto& found : frame.objects->objects)
    {
      ASSERT_TRUE(found.mask);
      EXPECT_EQ(found.box.x1, found.mask->x0);
      EXPECT_EQ(found.box.width() + 1, found.mask->width);
      ++boxes;
    }
  }
  EXPECT_GT(boxes, 20U);
}

/** A file with labels of pixels and without boxes, which is read again. */
class PixelLabelFile : public ::testing::TestWithParam<DetectorOutput>
{
};

TEST_P(PixelLabelFile, HoldsTheVisibleObjects)
{
  const TemporaryFolder folder;
  const Simulator simulator(faultlessHome(GetParam()), LabelTable::installed(), 1);
  simulateToFiles(simulator, folder.path("a.rawlog"));
  EXPECT_EQ(3U, folder.fileCount()) << "no file of boxes";
  RawlogSource source(folder.path("a.rawlog"), RawlogSourceOptions());
  const bool instances = GetParam() == DetectorOutput::Instances;
  std::size_t same = 0, visible = 0;
  std::set<std::uint32_t> ids;
  for (std::size_t i = 0; const auto frame = source.next(); ++i)
  {
    ASSERT_TRUE(frame->scan->hasPixelLabels());
    std::set<std::string> unknown;
    const auto boxes = boxesFromPixelLabels(*frame->scan, LabelTable::installed(), 1, unknown);
    EXPECT_TRUE(unknown.empty());
    for (const auto& seen : simulator.frame(i).visible)
    {
      ++visible;
      for (const auto& found : boxes->objects)
      {
        const std::string& label = simulator.scene().objects[seen.object].label;
        if (found.label.compare(0, label.size(), label) != 0) continue;
        EXPECT_EQ(instances, found.instanceId.has_value());
        if (imageBoxIoU(found.box, seen.box) < 0.999) continue;
        ++same;
        if (found.instanceId) ids.insert(*found.instanceId);
      }
    }
  }
  ASSERT_GT(visible, 20U);
  // Classes: where two of a kind touch, or one is seen in parts, groups of pixels are not objects.
  EXPECT_GE(same, instances ? visible : visible * 2 / 3);
  EXPECT_GE(ids.size(), instances ? 10U : 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, PixelLabelFile, ::testing::Values(DetectorOutput::Classes, DetectorOutput::Instances));

}  // namespace
}  // namespace quadmap::simulator
