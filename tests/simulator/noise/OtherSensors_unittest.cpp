#include <gtest/gtest.h>

#include "../SceneFixture.h"
#include "NoisyDepthFixture.h"
#include "noise/DepthNoise.h"

// Errors that a structured-light camera does not have by default.

namespace quadmap::simulator
{
namespace
{
/** A wall, all in one colour, with something nearer left of the middle. */
RenderedFrame edgeAt(double left, double right, std::uint8_t brightness)
{
  RenderedFrame frame;
  frame.camera = smallCamera();
  const std::size_t pixels = 160 * 120;
  for (std::size_t i = 0; i < pixels; ++i)
    frame.depth.push_back(static_cast<float>(i % 160 < 80 ? left : right));
  frame.cosIncidence.assign(pixels, 1.0F);
  frame.returnsDepth.assign(pixels, 1);
  frame.rgb.assign(3 * pixels, brightness);
  return frame;
}

TEST(OtherSensors, BleedingWidensWhatIsNearWithinItsReach)
{
  DepthNoiseOptions options = perfect();
  options.bleeding = 16;  // 4 px of an image of 160
  const auto depth = measured(edgeAt(1.5, 2.5, 255), options);
  double widened = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u)
    {
      const double z = depth[static_cast<std::size_t>(160 * v + u)];
      if (u < 80 || u >= 84)
        EXPECT_NEAR(u < 80 ? 1.5 : 2.5, z, 1e-6) << "what is near, or beyond the reach, stays";
      else
        widened += z < 2 ? 1 : 0;
    }
  EXPECT_NEAR(2, widened / 120, 0.8) << "on average half the reach";
}

TEST(OtherSensors, OnlyDarkSurfacesHaveDarkHolesAndNoise)
{
  DepthNoiseOptions options = perfect();
  options.darkHoles = 0.5;
  const auto holes = [&](std::uint8_t brightness)
  {
    const auto depth = measured(edgeAt(2, 2, brightness), options);
    return static_cast<double>(std::count(depth.begin(), depth.end(), 0.0)) / (160 * 120);
  };
  EXPECT_EQ(0, holes(120));
  EXPECT_NEAR(0.5, holes(0), 0.12) << "some 700 patches of 3.5 x 3.5 px";
  EXPECT_NEAR(0.25, holes(45), 0.1) << "half as dark";

  options = perfect();
  options.axialBase = 0.002;
  options.darkNoise = 3;
  EXPECT_NEAR(0.002, momentsOf(measured(edgeAt(2, 2, 200), options)).deviation, 1e-4);
  EXPECT_NEAR(0.008, momentsOf(measured(edgeAt(2, 2, 0), options)).deviation, 4e-4);
}

TEST(OtherSensors, CalibrationsErrInTheSameWayInEveryFrame)
{
  const std::size_t middle = 60 * 160 + 80;
  DepthNoiseOptions options = perfect();
  options.scaleError = 0.01;
  EXPECT_NEAR(2.02, measured(edgeAt(2, 2, 255), options)[middle], 1e-6);
  options = perfect();
  options.warp = 0.001;
  const auto warped = measured(edgeAt(2, 2, 255), options);
  EXPECT_NEAR(2.004, warped[middle], 1e-5) << "0.001 / m times z^2";
  EXPECT_NEAR(1.996, warped[0], 1e-5) << "the opposite in the corner";
  options = perfect();
  options.wiggle = 0.01;
  EXPECT_NEAR(1.885, measured(edgeAt(1.875, 1.875, 255), options)[middle], 1e-5)
      << "a quarter of a period after 1.5 m";
}

}  // namespace
}  // namespace quadmap::simulator
