#pragma once

#include <Eigen/Dense>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** Brightness of a material at a point of its body, within 1 +- contrast and 1 on average. It only
 * depends on the position, so that the surface looks the same in every frame. */
double textureBrightness(const Material& material, const Eigen::Vector3d& p);

}  // namespace quadmap::simulator
