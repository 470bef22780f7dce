#pragma once

#include <Eigen/Dense>

#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** Brightness of a material at a point of its body, 1 on average, within 1 +- contrast. A fixed
 * function of position, so that the surface looks the same in every frame. */
double textureBrightness(const Material& material, const Eigen::Vector3d& p);

}  // namespace quadmap::simulator
