#include "noise/DepthNoise.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <set>

#include "../SceneFixture.h"
#include "NoisyDepthFixture.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
/** An image full of a wall that faces the camera. */
RenderedFrame wallAt(double z)
{
  RenderedFrame frame;
  frame.camera = smallCamera();
  const std::size_t pixels = 160 * 120;
  frame.depth.assign(pixels, static_cast<float>(z));
  frame.cosIncidence.assign(pixels, 1.0F);
  frame.returnsDepth.assign(pixels, 1);
  return frame;
}

TEST(DepthNoise, PerfectSensorReturnsTheDepth)
{
  for (const double z : measured(wallAt(2.345), perfect())) ASSERT_NEAR(2.345, z, 1e-6);
}

TEST(DepthNoise, AxialSigmaGrowsAsPublished)
{
  DepthNoiseOptions options = perfect();
  options.axialBase = 0.0012;
  options.axialGrowth = 0.0019;
  for (const auto& [z, sigma] : {
           std::pair{0.6, 0.001276},
           {2.0, 0.006064},
           {4.0, 0.025824}
  })
  {
    const Moments m = momentsOf(measured(wallAt(z), options));
    // Of n = 19200 samples: mean +- sigma / 139, deviation +- sigma / 196; 4 of each.
    EXPECT_NEAR(z, m.mean, 4 * sigma / 139);
    EXPECT_NEAR(sigma, m.deviation, 4 * sigma / 196);
  }
}

/** Errors of depth in the middle of default images of a wall at the depth z [m]. */
std::vector<double> errorsOfImages(double z)
{
  std::string text = kRoomText + "bob = 0\nsway_deg = 0\n";
  text.replace(text.find("6 6 2.6"), 7, mrpt::format("%g 6 2.6", 2 * z));
  std::vector<double> errors;
  for (const std::uint64_t seed : {1, 2, 3})
  {
    const Simulator simulator(sceneFromText(text), LabelTable::installed(), seed);
    const auto scan = simulator.frame(0).scan;
    for (int v = 140; v < 340; ++v)
      for (int u = 220; u < 420; ++u)
        if (scan->rangeImage(v, u) > 0)
          errors.push_back(
              static_cast<double>(scan->rangeImage(v, u)) * static_cast<double>(scan->rangeUnits) -
              z);
  }
  return errors;
}

TEST(DepthNoise, DefaultImagesErrAsPublished)
{
  for (const double z : {1.0, 2.0, 3.0, 4.0, 6.0})
  {
    // Nguyen, Izadi, Lovell 2012; and steps of 1/8 px of disparity, f b = 580 px * 0.075 m.
    const double published = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
    const double step = z * z * 0.125 / (580 * 0.075);
    const Moments m = momentsOf(errorsOfImages(z));
    // Windows of 49 correlated pixels: 2400 independent errors, deviation +- 1.4 %; 4 of these.
    EXPECT_NEAR(1, m.deviation / std::hypot(published, step / std::sqrt(12)), 0.06) << z << " m";
    EXPECT_NEAR(1, m.deviation / published, 0.2) << z << " m: steps add up to 14 %";
    EXPECT_NEAR(0, m.mean, 4 * m.deviation / std::sqrt(2400)) << z << " m";
  }
}

TEST(DepthNoise, IsCorrelatedOverTheWindowAndKeepsItsSigma)
{
  DepthNoiseOptions options = perfect();
  options.axialBase = 0.01;
  for (const double window : {3.0, 5.0})  // in the image of 160 px, a quarter of the option
  {
    options.window = 4 * window;
    std::vector<double> products(9, 0.0), squares;
    double n = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
      const auto depth = measured(wallAt(2), options, seed);
      for (std::size_t i = 0; i < depth.size(); ++i) squares.push_back(depth[i] - 2);
      for (std::size_t v = 0; v < 120; v += 3)
        for (std::size_t u = 0; u < 150; ++u, ++n)
          for (std::size_t lag = 0; lag < products.size(); ++lag)
            products[lag] += (depth[v * 160 + u] - 2) * (depth[v * 160 + u + lag] - 2);
    }
    EXPECT_NEAR(0, momentsOf(squares).mean, 5e-4);
    EXPECT_NEAR(0.01, momentsOf(squares).deviation, 2e-4);
    // Two windows of w pixels, l apart, share w - l of them.
    for (std::size_t lag = 0; lag < products.size(); ++lag)
      EXPECT_NEAR(
          std::max(0.0, 1 - static_cast<double>(lag) / window), products[lag] / n / 1e-4, 0.06)
          << "window " << window << ", lag " << lag;
  }
}

TEST(DepthNoise, DisparityHasAQuantum)
{
  DepthNoiseOptions options = perfect();
  options.disparityStep = 0.125;
  options.axialBase = 0.1;
  std::set<double> values;
  for (const double z : measured(wallAt(3), options))
  {
    const double disparity = options.sensorFocal * options.baseline / z;  // [px]
    EXPECT_NEAR(disparity * 8, std::round(disparity * 8), 1e-3);
    values.insert(z);
  }
  ASSERT_GT(values.size(), 5U);
  // dz = z^2 / (f b) dd: 26 mm at 3 m, known from the Kinect.
  const auto next = values.upper_bound(2.99);
  EXPECT_NEAR(0.0259, *std::next(next) - *next, 0.001);
}

TEST(DepthNoise, NothingReturnsFromScreensFlatAnglesAndOutOfRange)
{
  const DepthNoiseOptions options = perfect();
  const auto measures = [&](const RenderedFrame& frame)
  { return measured(frame, options)[5000] > 0; };
  EXPECT_TRUE(measures(wallAt(0.51)));
  EXPECT_TRUE(measures(wallAt(7.9)));
  EXPECT_FALSE(measures(wallAt(0.49)));
  EXPECT_FALSE(measures(wallAt(8.1)));
  RenderedFrame frame = wallAt(2);
  frame.cosIncidence.assign(frame.depth.size(), static_cast<float>(std::cos(mrpt::DEG2RAD(79.0))));
  EXPECT_TRUE(measures(frame));
  frame.cosIncidence.assign(frame.depth.size(), static_cast<float>(std::cos(mrpt::DEG2RAD(81.0))));
  EXPECT_FALSE(measures(frame));
  frame = wallAt(2);
  frame.returnsDepth.assign(frame.depth.size(), 0);
  EXPECT_FALSE(measures(frame));
}

TEST(DepthNoise, DropoutsHaveTheirShare)
{
  DepthNoiseOptions options = perfect();
  options.dropouts = 0.02;
  const auto depth = measured(wallAt(2), options);
  const double n = static_cast<double>(depth.size());
  const double share = static_cast<double>(std::count(depth.begin(), depth.end(), 0.0)) / n;
  EXPECT_NEAR(0.02, share, 4 * std::sqrt(0.02 * 0.98 / n));
}

/** An image of a step: near to the right of column 80, and far to the left of it. */
RenderedFrame stepEdge(double near, double far)
{
  RenderedFrame frame = wallAt(far);
  for (std::size_t i = 0; i < frame.depth.size(); ++i)
    if (i % 160 >= 80) frame.depth[i] = static_cast<float>(near);
  return frame;
}

TEST(DepthNoise, EdgesHaveHolesAndFlyingPixels)
{
  DepthNoiseOptions options = perfect();
  options.edgeHoles = 0.3;
  options.edgeFlying = 0.2;
  unsigned holes = 0, flying = 0, edge = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
  {
    const auto depth = measured(stepEdge(1, 2), options, seed);
    for (std::size_t i = 0; i < depth.size(); ++i)
    {
      const bool atEdge = i % 160 == 79 || i % 160 == 80;
      const bool between = depth[i] > 1.001 && depth[i] < 1.999;
      ASSERT_TRUE(atEdge || (depth[i] > 0 && !between)) << "only at edges";
      edge += atEdge;
      holes += depth[i] == 0;
      flying += between;
    }
  }
  ASSERT_EQ(40U * 240, edge);
  EXPECT_NEAR(0.3, holes / double(edge), 4 * std::sqrt(0.3 * 0.7 / edge));
  EXPECT_NEAR(0.2, flying / double(edge), 4 * std::sqrt(0.2 * 0.8 / edge));
}

TEST(DepthNoise, SlopesAreNoEdges)
{
  RenderedFrame frame = wallAt(1);
  for (std::size_t i = 0; i < frame.depth.size(); ++i)
    frame.depth[i] = static_cast<float>(1.0 / (1.0 - 0.005 * static_cast<double>(i % 160)));
  DepthNoiseOptions options = perfect();
  options.edgeHoles = 1;
  options.edgeJump = 0.03;
  options.maxRange = 13;
  // A plane, at its steepest 2.4 % per pixel and side; only the image's border has one neighbour.
  const auto depth = measured(frame, options);
  for (std::size_t i = 0; i < depth.size(); ++i)
    ASSERT_TRUE(depth[i] > 0 || i % 160 == 0 || i % 160 == 159) << i % 160;
}

TEST(DepthNoise, LateralJitterMovesEdgesByItsSigma)
{
  DepthNoiseOptions options = perfect();
  options.lateral = 4 * 1.5;  // 1.5 px in an image 160 px wide
  std::vector<double> shares;
  double nearWhereFar = 0, farWhereNear = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    const auto depth = measured(stepEdge(1, 2), options, seed);
    for (std::size_t i = 0; i < depth.size(); ++i)
    {
      const bool near = depth[i] < 1.5;
      if (i % 160 == 79) nearWhereFar += near;
      if (i % 160 == 82) farWhereNear += !near;
    }
  }
  // P(79 + x rounds to >= 80), P(82 + x rounds to < 80) for x ~ N(0, 1.5): normal tails.
  const double n = 20 * 120;
  EXPECT_NEAR(0.5 * std::erfc(0.5 / 1.5 / std::sqrt(2)), nearWhereFar / n, 0.04) << "4 sigma";
  EXPECT_NEAR(0.5 * std::erfc(2.5 / 1.5 / std::sqrt(2)), farWhereNear / n, 0.02) << "4 sigma";
}

TEST(DepthNoise, ProjectorShadowLiesLeftOfNearThings)
{
  DepthNoiseOptions options = perfect();
  options.shadow = true;
  const auto depth = measured(stepEdge(1, 2), options);
  // f b (1/1 - 1/2) with f = 131.25 px: 4.9 px.
  for (std::size_t u = 0; u < 160; ++u) EXPECT_EQ(u >= 76 && u < 80, depth[160 * 60 + u] == 0) << u;
}

TEST(RandomStream, HasTheMomentsOfItsDistributionsAndSeparateStreams)
{
  RandomStream random(5, Purpose::Depth, 3);
  std::vector<double> uniform, gaussian;
  std::vector<int> below(5, 0);
  for (int i = 0; i < 40000; ++i)
  {
    uniform.push_back(random.uniform(-1, 3));
    gaussian.push_back(random.gaussian());
    ++below.at(random.below(5));
  }
  EXPECT_NEAR(1, momentsOf(uniform).mean, 4 * 1.155 / 200) << "4 sigma";
  EXPECT_NEAR(4 / std::sqrt(12), momentsOf(uniform).deviation, 0.02);
  EXPECT_NEAR(0, momentsOf(gaussian).mean, 4.0 / 200);
  EXPECT_NEAR(1, momentsOf(gaussian).deviation, 4.0 / 283);
  const auto beyond =
      std::count_if(gaussian.begin(), gaussian.end(), [](double x) { return std::abs(x) > 1.96; });
  EXPECT_NEAR(0.05, static_cast<double>(beyond) / 40000, 4 * 0.00109);
  for (const int count : below) EXPECT_NEAR(8000, count, 4 * 80);

  const auto first = [](std::uint64_t seed, Purpose purpose, std::uint64_t frame)
  { return RandomStream(seed, purpose, frame).uniform(); };
  const std::set<double> different{
      first(1, Purpose::Depth, 0), first(2, Purpose::Depth, 0), first(1, Purpose::Color, 0),
      first(1, Purpose::Depth, 1), first(0, Purpose::Depth, 0)};
  EXPECT_EQ(5U, different.size());
  EXPECT_EQ(first(1, Purpose::Depth, 0), first(1, Purpose::Depth, 0));
}

}  // namespace
}  // namespace quadmap::simulator
