#pragma once

#include <vector>

#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** A bend, with steps that err by different amounts in all directions. */
inline std::vector<Keyframe> bentDrive()
{
  std::vector<Keyframe> keyframes(9);
  const mrpt::poses::CPose3D step(0.4, 0.05, 0.01, 0.3, 0.2, -0.1);
  keyframes[0].T_map_robot = mrpt::poses::CPose3D(2, -1, 0.3, 1.0, 0.05, 0.02);
  for (std::size_t k = 1; k < keyframes.size(); ++k)
  {
    keyframes[k].T_map_robot = keyframes[k - 1].T_map_robot + step;
    mrpt::poses::CPose3DPDFGaussian measured(step);
    for (int i = 0; i < 6; ++i) measured.cov(i, i) = 1e-6 * (i + 1) * (i + 1);
    keyframes[k].odometryStep = measured;
  }
  return keyframes;
}
}  // namespace quadmap
