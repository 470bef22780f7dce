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

/** The rim of a dark board (grey 6) before a light wall (grey 73 to 90) in the middle row. */
struct Rim
{
  explicit Rim(const SimulatedFrame& frame)
  {
    for (int u = 0; u < 160; ++u)
    {
      const int grey = frame.scan->intensityImage.at<std::uint8_t>(u, 60, 0);
      dark += grey < 40 ? 1 : 0;
      between += grey > 12 && grey < 70 ? 1 : 0;
    }
  }
  int dark = 0, between = 0;  // pixels
};

TEST(MotionBlur, FollowsTheCameraThatWalks)
{
  // It walks aside in its second quarter, past the rim of a dark board.
  Scene scene = sceneFromText(
      kRoomText +
      "[object board]\nlabel = tv\nposition = 2.5 1.5 0\npart1 = box 0 0 1.3 0.1 2.9 2.6 screen\n");
  for (auto& waypoint : scene.waypoints) waypoint.target = waypoint.eye + Eigen::Vector3d(2, 0, 0);
  scene.options.resize(160, 120);
  scene.options.camera.colorNoise = 0;
  scene.options.trajectory.duration = 2;
  scene.options.trajectory.frames = 20;
  scene.options.camera.exposure = 0.1;  // to the next frame
  const Simulator blurred(scene, LabelTable::installed(), 1);
  scene.options.camera.exposure = 0;
  const Simulator sharp(scene, LabelTable::installed(), 1);
  constexpr std::size_t kAside = 7;
  const auto a = blurred.frame(kAside), b = sharp.frame(kAside);
  const Rim before(b), after(sharp.frame(kAside + 1));
  const int moved = after.dark - before.dark;
  EXPECT_GE(moved, 5) << "or the test says nothing";
  EXPECT_LE(before.between, 1);
  EXPECT_NEAR(moved - 1, Rim(a).between, 1.5) << "[px]";
  EXPECT_EQ(a.scan->rangeImage, b.scan->rangeImage) << "depth is not blurred";
  EXPECT_EQ(blurred.truePoses()[kAside].asString(), sharp.truePoses()[kAside].asString())
      << "nor the way";
}

}  // namespace
}  // namespace quadmap::simulator
