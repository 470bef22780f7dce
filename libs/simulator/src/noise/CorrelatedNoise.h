#pragma once

#include <vector>

#include "quadmap/simulator/RandomStream.h"

namespace quadmap::simulator
{
/** Gaussian errors with mean 0 and standard deviation 1 that are correlated over a square window,
 * row major. \param window Its side [px]. */
std::vector<double> windowedNoise(int width, int height, double window, RandomStream& random);

}  // namespace quadmap::simulator
