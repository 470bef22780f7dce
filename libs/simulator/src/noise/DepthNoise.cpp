#include "noise/DepthNoise.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap::simulator
{
namespace
{
/** Weights of a window of some width [px] about its middle pixel. The pixels at its ends count in
 * part. A weighted sum of independent errors has the variance of one of them. */
std::vector<double> windowWeights(double width)
{
  const int reach = static_cast<int>(std::ceil((width - 1) / 2));
  std::vector<double> weights;
  double squares = 0;
  for (int k = -reach; k <= reach; ++k)
  {
    weights.push_back(std::clamp(0.5 * (width + 1) - std::abs(k), 0.0, 1.0));
    squares += weights.back() * weights.back();
  }
  for (double& w : weights) w /= std::sqrt(squares);
  return weights;
}

/** Gaussian errors with mean 0 and standard deviation 1 that are correlated over a square window,
 * row major. */
std::vector<double> windowedNoise(int width, int height, double window, RandomStream& random)
{
  const auto weights = windowWeights(window);
  const auto n = weights.size();
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  const std::size_t wide = columns + n - 1;  // width with a margin for the window
  std::vector<double> lines((rows + n - 1) * columns, 0.0), line(wide);
  for (std::size_t v = 0; v < rows + n - 1; ++v)
  {
    for (double& x : line) x = random.gaussian();
    for (std::size_t u = 0; u < columns; ++u)
      for (std::size_t k = 0; k < n; ++k) lines[v * columns + u] += weights[k] * line[u + k];
  }
  std::vector<double> result(rows * columns, 0.0);
  for (std::size_t v = 0; v < rows; ++v)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t u = 0; u < columns; ++u)
        result[v * columns + u] += weights[k] * lines[(v + k) * columns + u];
  return result;
}

/** A structured-light camera. Its functions are in the order in which they affect the light. */
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

    const std::size_t source = index(su, sv);
    if (frame_.returnsDepth[source] == 0) return 0;
    if (static_cast<double>(frame_.cosIncidence[source]) < minCosIncidence_) return 0;
    if (dice < options_.dropouts) return 0;

    double z = depthAt(su, sv);
    const auto [low, high] = depthsAround(su, sv);
    if (high - low > options_.edgeJump * low)
    {
      const double fate = (dice - options_.dropouts) / std::max(1e-12, 1 - options_.dropouts);
      if (fate < options_.edgeHoles) return 0;
      if (fate < options_.edgeHoles + options_.edgeFlying) z = low + mix * (high - low);
    }
    if (z < options_.minRange || z > options_.maxRange) return 0;
    z = quantizedDepth(options_, z + axialSigma(options_, z) * error);
    return z > 0 && z <= options_.maxRange ? static_cast<float>(z) : 0.0F;
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
