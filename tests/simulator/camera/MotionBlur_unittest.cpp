#include "camera/MotionBlur.h"

#include <gtest/gtest.h>

#include "../SceneFixture.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
/** Black left of the middle and white right of it, 2 m away. */
RenderedFrame edge()
{
  RenderedFrame frame;
  frame.camera = smallCamera();
  for (int i = 0; i < 160 * 120; ++i)
  {
    frame.depth.push_back(2);
    frame.rgb.insert(frame.rgb.end(), 3, i % 160 < 80 ? 0 : 255);
  }
  return frame;
}

TEST(MotionBlur, SpreadsAnEdgeOverTheMotionOfItsPixels)
{
  RenderedFrame frame = edge();
  const double turn = 8 / frame.camera.fx;  // 8 px in the middle of the image
  blurByMotion(frame, {0, 0, 0, turn, 0, 0});
  // It grows with 1 + x^2 / f^2 towards the borders, where x^2 is 80^2 / 3 px^2 on average.
  EXPECT_NEAR(8 * (1 + 80 * 80 / 3.0 / (frame.camera.fx * frame.camera.fx)), frame.blur, 0.2);
  int grey = 0;
  for (int u = 0; u < 160; ++u)
  {
    const std::uint8_t value = frame.rgb[3 * static_cast<std::size_t>(60 * 160 + u)];
    grey += value > 0 && value < 255 ? 1 : 0;
  }
  EXPECT_NEAR(8, grey, 1);

  RenderedFrame aside = edge();
  blurByMotion(aside, {0, 0.1, 0, 0, 0, 0});
  EXPECT_NEAR(0.1 * aside.camera.fx / 2, aside.blur, 1e-6) << "0.1 m at 2 m";
}

TEST(MotionBlur, DoesNothingStandingStill)
{
  RenderedFrame frame = edge();
  const auto before = frame.rgb;
  blurByMotion(frame, {});
  EXPECT_EQ(before, frame.rgb);
  EXPECT_NEAR(0, frame.blur, 1e-9);
}

TEST(MotionBlur, FollowsTheCameraThatWalks)
{
  Scene scene = sceneFromText(kRoomText);
  scene.options.resize(160, 120);
  scene.options.camera.exposure = 0.1;
  scene.options.trajectory.duration = 2;
  const Simulator blurred(scene, LabelTable::installed(), 1);
  scene.options.camera.exposure = 0;
  const Simulator sharp(scene, LabelTable::installed(), 1);
  const auto a = blurred.frame(1), b = sharp.frame(1);
  EXPECT_EQ(a.scan->rangeImage, b.scan->rangeImage) << "depth is not blurred";
  EXPECT_EQ(blurred.truePoses()[1].asString(), sharp.truePoses()[1].asString()) << "nor the way";
}

}  // namespace
}  // namespace quadmap::simulator
