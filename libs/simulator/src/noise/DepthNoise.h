#pragma once

#include <vector>

#include "quadmap/simulator/RandomStream.h"
#include "quadmap/simulator/RayCaster.h"

namespace quadmap::simulator
{
/** Standard deviation of a depth z before it is quantised [m]. */
double axialSigma(const DepthNoiseOptions& options, double z);

/** The depth of which the disparity is that of z, rounded to the quantum of the sensor [m]. */
double quantizedDepth(const DepthNoiseOptions& options, double z);

/** The depths that a structured-light camera measures in a frame [m], row major; 0 for none. */
std::vector<float> noisyDepth(
    const RenderedFrame& frame, const DepthNoiseOptions& options, RandomStream& random);

}  // namespace quadmap::simulator
