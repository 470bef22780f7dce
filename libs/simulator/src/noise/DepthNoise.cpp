#include "noise/DepthNoise.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "noise/CorrelatedNoise.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kPatch = 14;        // width of the patches of dark holes [px at 640]
constexpr double kBright = 90;       // what is brighter than this, of 255, returns enough light
constexpr double kWavePeriod = 1.5;  // half the wave length of a modulation by 100 MHz [m]

/** A depth camera. Its functions are in the order in which they affect the light. */
class DepthSensor
{
 public:
  DepthSensor(const RenderedFrame& frame, const DepthNoiseOptions& options, RandomStream& random) :
      frame_(frame),
      options_(options),
      random_(random),
      width_(static_cast<int>(frame.camera.width)),
      height_(static_cast<int>(frame.camera.height)),
      lateral_(options.lateral * width_ / 640.0),
      minCosIncidence_(std::cos(mrpt::DEG2RAD(options.maxIncidence_deg)))
  {
  }

  std::vector<float> measure()
  {
    const double window = options_.window * width_ / 640.0;
    if (window > 1) correlated_ = windowedNoise(width_, height_, window, random_);
    const double patch = kPatch * width_ / 640.0;
    if (options_.darkHoles > 0 || options_.bleeding > 0)
      patches_ = windowedNoise(width_, height_, std::max(patch, 1.0), random_);
    std::vector<float> result(frame_.depth.size(), 0.0F);
    std::vector<bool> lit(static_cast<std::size_t>(width_), true);
    for (int v = 0; v < height_; ++v)
    {
      if (options_.shadow) findShadows(v, lit);
      for (int u = 0; u < width_; ++u)
        if (lit[static_cast<std::size_t>(u)]) result[index(u, v)] = measurePixel(u, v);
    }
    return result;
  }

 private:
  std::size_t index(int u, int v) const
  {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }
  double depthAt(int u, int v) const { return static_cast<double>(frame_.depth[index(u, v)]); }

  /** Finds the pixels in the shadow of the projector, which is to the right of the camera. It
   * lights the point of pixel u from u - f b / z, unless a point farther right in the image is lit
   * from there or from farther left. */
  void findShadows(int v, std::vector<bool>& lit) const
  {
    const double fb = frame_.camera.fx * options_.baseline;
    double leftmost = std::numeric_limits<double>::infinity();
    for (int u = width_ - 1; u >= 0; --u)
    {
      const double seenAt = u - fb / depthAt(u, v);
      lit[static_cast<std::size_t>(u)] = seenAt <= leftmost;
      leftmost = std::min(leftmost, seenAt);
    }
  }

  float measurePixel(int u, int v)
  {
    // Each pixel draws the same number of random numbers, so that it does not change the others.
    const int su = std::clamp(jittered(u), 0, width_ - 1);
    const int sv = std::clamp(jittered(v), 0, height_ - 1);
    const double dice = random_.uniform(), mix = random_.uniform(), noise = random_.gaussian();
    const double error = correlated_.empty() ? noise : correlated_[index(u, v)];

    const std::size_t source = options_.bleeding > 0 ? nearestBeside(su, sv) : index(su, sv);
    if (frame_.returnsDepth[source] == 0) return 0;
    if (static_cast<double>(frame_.cosIncidence[source]) < minCosIncidence_) return 0;
    if (dice < options_.dropouts || isDarkHole(source)) return 0;

    double z = static_cast<double>(frame_.depth[source]);
    const auto [low, high] = depthsAround(su, sv);
    if (high - low > options_.edgeJump * low)
    {
      const double fate = (dice - options_.dropouts) / std::max(1e-12, 1 - options_.dropouts);
      if (fate < options_.edgeHoles) return 0;
      if (fate < options_.edgeHoles + options_.edgeFlying) z = low + mix * (high - low);
    }
    if (z < options_.minRange || z > options_.maxRange) return 0;
    const double sigma = axialSigma(options_, z) * darkFactor(source);
    z = quantizedDepth(options_, z + systematicError(u, v, z) + sigma * error);
    return z > 0 && z <= options_.maxRange ? static_cast<float>(z) : 0.0F;
  }

  /** 0 for what is brighter than a third, 1 for black. Dark things are taken as dark in infrared.
   */
  double darkness(std::size_t pixel) const
  {
    const std::uint8_t* rgb = &frame_.rgb[3 * pixel];
    return std::max(0.0, 1 - *std::max_element(rgb, rgb + 3) / kBright);
  }

  double darkFactor(std::size_t pixel) const
  {
    return options_.darkNoise > 0 ? 1 + options_.darkNoise * darkness(pixel) : 1.0;
  }

  /** Whole patches of a dark surface have no depth, and the same share of its pixels. */
  bool isDarkHole(std::size_t pixel) const
  {
    if (options_.darkHoles <= 0) return false;
    const double share = options_.darkHoles * darkness(pixel);
    return 0.5 * std::erfc(patches_[pixel] / std::sqrt(2.0)) < share;
  }

  /** The nearest surface within the reach of a matching window, which is not the same everywhere.
   */
  std::size_t nearestBeside(int u, int v) const
  {
    const double most = options_.bleeding * width_ / 640.0;
    const double share = 0.5 * std::erfc(patches_[index(u, v)] / std::sqrt(2.0));
    const int reach = static_cast<int>(std::lround(most * share));
    std::size_t best = index(u, v);
    const double near = depthAt(u, v) / (1 + options_.edgeJump);
    for (int k = 1; k <= reach; ++k)
      for (const auto& [du, dv] : {
               std::pair{-k,  0},
               { k,  0},
               { 0, -k},
               { 0,  k}
      })
      {
        const int x = std::clamp(u + du, 0, width_ - 1), y = std::clamp(v + dv, 0, height_ - 1);
        const double z = depthAt(x, y);
        if (z < near && z < static_cast<double>(frame_.depth[best])) best = index(x, y);
      }
    return best;
  }

  /** What is wrong in the same way in every frame [m]. */
  double systematicError(int u, int v, double z) const
  {
    const double x = 2.0 * u / width_ - 1, y = 2.0 * v / height_ - 1;
    return options_.scaleError * z + options_.warp * z * z * (1 - x * x - y * y) +
           options_.wiggle * std::sin(2 * M_PI * z / kWavePeriod);
  }

  int jittered(int x) { return static_cast<int>(std::lround(x + lateral_ * random_.gaussian())); }

  /** Smallest and largest depth of a pixel and its four neighbours, after the slope of a plane
   * through them was removed [m]. */
  std::pair<double, double> depthsAround(int u, int v) const
  {
    const double z = depthAt(u, v);
    double low = z, high = z;
    const int left = std::max(u - 1, 0), right = std::min(u + 1, width_ - 1);
    const int above = std::max(v - 1, 0), below = std::min(v + 1, height_ - 1);
    const auto look = [&](double a, double b)
    {
      const double slope = std::min(std::abs(z - a), std::abs(b - z));
      low = std::min({low, a + slope, b + slope});
      high = std::max({high, a - slope, b - slope});
    };
    look(depthAt(left, v), depthAt(right, v));
    look(depthAt(u, above), depthAt(u, below));
    return {low, high};
  }

  const RenderedFrame& frame_;
  const DepthNoiseOptions& options_;
  RandomStream& random_;
  const int width_, height_;
  const double lateral_;  // [px]
  const double minCosIncidence_;
  std::vector<double> patches_;     // of holes and of the reach of bleeding; empty without both
  std::vector<double> correlated_;  // errors of the pixels; empty when they are independent
};

}  // namespace

double axialSigma(const DepthNoiseOptions& options, double z)
{
  return options.axialBase + options.axialGrowth * (z - 0.4) * (z - 0.4);
}

double quantizedDepth(const DepthNoiseOptions& options, double z)
{
  if (options.disparityStep <= 0 || z <= 0) return z;
  const double fb = options.sensorFocal * options.baseline;
  const double steps = std::round(fb / (z * options.disparityStep));
  return steps > 0 ? fb / (steps * options.disparityStep) : 0;
}

std::vector<float> noisyDepth(
    const RenderedFrame& frame, const DepthNoiseOptions& options, RandomStream& random)
{
  return DepthSensor(frame, options, random).measure();
}

}  // namespace quadmap::simulator
