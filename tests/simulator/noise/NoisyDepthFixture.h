#pragma once

#include <cstdint>
#include <vector>

#include "noise/DepthNoise.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
/** Options without errors, of which a test switches some on. */
inline DepthNoiseOptions perfect()
{
  SimulatorOptions options;
  options.scaleNoise(0);
  options.depthNoise.shadow = false;
  options.depthNoise.window = 0;
  return options.depthNoise;
}

/** What a sensor with these options measures of a frame [m]. */
inline std::vector<double> measured(
    const RenderedFrame& frame, const DepthNoiseOptions& options, std::uint64_t seed = 1)
{
  RandomStream random(seed, Purpose::Depth, 0);
  const auto depth = noisyDepth(frame, options, random);
  return {depth.begin(), depth.end()};
}
}  // namespace quadmap::simulator
