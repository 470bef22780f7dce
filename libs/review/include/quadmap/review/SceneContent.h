#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/ColouredCloud.h"

namespace quadmap
{
/** One keyframe's camera, drawn as a small pyramid. */
struct CameraPose
{
  mrpt::poses::CPose3D T_map_sensor;              //!< x forward, y left, z up
  double horizontalFov = 1.0, verticalFov = 0.8;  //!< Full opening angles [rad]
};

/** What a scene or a picture of a map can show; whatever is empty is left out. Map frame, z-up. */
struct SceneContent
{
  std::vector<ObjectRecord> objects;
  std::vector<ObjectRecord> truth;
  std::vector<mrpt::poses::CPose3D> trajectory;  //!< Corrected, in order of time
  std::vector<mrpt::poses::CPose3D> odometry;    //!< Not corrected, in order of time
  std::vector<CameraPose> cameras;
  Cloud cloud;
  double cloudCellSize = 0.015;  //!< Distance of neighbouring points of the cloud [m]

  /** Height of the floor, guessed from the lowest objects, else from the cloud, else from the
   *  trajectory [m]. */
  double floorHeight() const;

  /** Points that a picture must show: corners of the objects, the trajectories, the cameras; those
   *  of the cloud when there is nothing else. Empty in an empty scene. */
  std::vector<Eigen::Vector3d> extent() const;
};

}  // namespace quadmap
