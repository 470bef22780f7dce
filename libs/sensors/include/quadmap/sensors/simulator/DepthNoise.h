#pragma once

#include <vector>

#include "quadmap/sensors/simulator/RandomStream.h"
#include "quadmap/sensors/simulator/RayCaster.h"

namespace quadmap::simulator
{
/** Standard deviation of a depth before it is quantised [m]. */
double axialSigma(const DepthNoiseOptions& options, double z);

/** z as it looks after its disparity was rounded to the sensor's quantum [m]. */
double quantizedDepth(const DepthNoiseOptions& options, double z);

/** What a structured-light camera measures of a frame [m], row major, 0 = nothing. */
std::vector<float> noisyDepth(
    const RenderedFrame& frame, const DepthNoiseOptions& options, RandomStream& random);

}  // namespace quadmap::simulator
