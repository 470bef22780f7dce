#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "quadmap/maps/ObjectEstimator.h"
#include "quadmap/maps/ObjectView.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** One measurement of one object in the robot's frame: what the factor graph keeps of an
 * ObjectView, so that it stays the same when the robot's pose changes. */
struct RobotView
{
  struct Edge
  {
    Eigen::Vector3d normal;  //!< Of the plane through the camera, towards the object
    double sigma = 0;        //!< Of the tangency distance [m]
  };

  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Camera centre [m]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  //!< As ObjectView::center [m]

  bool complete = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();   //!< Of the cuboid, one per column
  Eigen::Vector3d halfSizes = Eigen::Vector3d::Ones();  //!< [m]
  std::array<FaceMeasurement, kFaces> faces;
  double faceExponent = 2.0;  //!< q of the faces' tangency, as ObjectView::faceExponent
  bool yawDefined = false;
  double yawSigma = 0;  //!< [rad]
  double tiltSigma =
      0;  //!< Of the cuboid's z axis, measured as a support's normal [rad]; 0: is not

  std::vector<Edge> edges;  //!< Those that are used

  bool hasSeed = false;  //!< Partial: `center` is a measurement of the object's centre
  Eigen::Matrix3d seedWhitening = Eigen::Matrix3d::Identity();  //!< [1/m]

  double weight = 1;  //!< Of all residuals, in (0, 1]
};

/** \param view Made from `detected` with T_map_robot + T_robot_sensor: its sigmas and kinds of
 *  faces are taken over.
 *  \param tiltSigma Of a support's normal [rad]; 0: it is no measurement of what is up. */
RobotView robotViewOf(
    const DetectedObject& detected,
    const ObjectView& view,
    const mrpt::poses::CPose3D& T_map_robot,
    const mrpt::poses::CPose3D& T_robot_sensor,
    const EstimatorOptions& options,
    double tiltSigma);

}  // namespace quadmap
