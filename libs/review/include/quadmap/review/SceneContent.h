#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <set>
#include <string>
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

/** What a scene or a picture of a map shows, in the frame of the map, which is z-up. Empty parts
 * are left out. */
struct SceneContent
{
  std::vector<ObjectRecord> objects;
  std::vector<ObjectRecord> truth;
  std::set<std::string> phantoms;                //!< Ids of objects that the truth does not have
  std::set<std::string> missed;                  //!< Ids of true objects that the map does not have
  std::vector<mrpt::poses::CPose3D> trajectory;  //!< Corrected poses in the order of time
  std::vector<mrpt::poses::CPose3D> odometry;    //!< Poses of the odometry in the order of time
  std::vector<CameraPose> cameras;
  Cloud cloud;
  double cloudCellSize = 0.015;  //!< Distance of neighbouring points of the cloud [m]

  /** Height of the floor [m]. It is guessed from the lowest objects or, without objects, from the
   *  cloud or, without a cloud, from the trajectory. */
  double floorHeight() const;

  /** Whether the odometry differs visibly from the trajectory. Equal lines on top of each other
   * would flicker. */
  bool odometryDiffers() const;

  /** Points that a picture must show: the corners of the objects, the trajectories and the cameras,
   *  or those of the cloud when there is nothing else. It is empty in an empty scene. */
  std::vector<Eigen::Vector3d> extent() const;
};

}  // namespace quadmap
