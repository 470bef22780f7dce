#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "cloud/ObjectCloud.h"

namespace quadmap
{
/** An object's cloud in the frame `upright`: origin at the camera, z up, x the horizontal direction
 * from the camera to the object. */
struct UprightCloud
{
  Eigen::Matrix3d R_upright_optical = Eigen::Matrix3d::Identity();
  std::vector<ObjectCloud::Cell> cells;  //!< A regular sample of the object's, at most some 1600
  std::vector<Eigen::Vector3d> points;
  std::vector<std::optional<Eigen::Vector3d>> normals;  //!< Unit, towards the camera
  double medianRange = 0;                               //!< Median depth of the points [m]
  double cellsPerSample = 1;                            //!< Of the depth cloud, for each one here
  double cellsPerNormal = 1;  //!< Cells that share the noise of one normal
};

/** \param up_optical Unit vector that points up. */
UprightCloud uprightCloud(
    const DepthCloud& cloud, const ObjectCloud& object, const Eigen::Vector3d& up_optical);

}  // namespace quadmap
