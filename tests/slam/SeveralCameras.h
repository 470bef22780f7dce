#pragma once

#include <mrpt/core/bits_math.h>

#include <vector>

#include "SyntheticRoom.h"

namespace quadmap
{
/** The room as the four cameras of a robot see it. Two are turned upright, as on the robot of the
 * Robot@Home data set. One is upside down and has another resolution. One looks the other way. */
inline std::vector<SyntheticRoom> fourCameras()
{
  using mrpt::DEG2RAD;
  using mrpt::poses::CPose3D;
  std::vector<SyntheticRoom> cameras(4);
  const double quarter = DEG2RAD(90.0);
  cameras[0].T_robot_camera = CPose3D(0.1, 0.05, 1.3, 0.05, 0.45, quarter);
  cameras[1].T_robot_camera = CPose3D(0.1, -0.05, 1.3, -0.05, 0.45, -quarter);
  cameras[2].T_robot_camera = CPose3D(0, 0, 1.2, 0, 0.4, 2 * quarter);
  cameras[2].camera = PinholeCamera{180, 175, 110.0, 85.0, 224, 168};
  cameras[3].T_robot_camera = CPose3D(-0.1, 0, 1.3, 2 * quarter, 0.45, 0);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    cameras[i].sensor = "RGBD_" + std::to_string(i + 1);
  return cameras;
}

}  // namespace quadmap
