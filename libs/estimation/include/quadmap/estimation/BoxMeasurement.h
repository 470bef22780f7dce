#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/MeasuredGeometry.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** Side of an object's box in an image with up upwards. */
enum class BoxSide
{
  Upper,
  Lower,
  Left,
  Right
};

/** Which side of its box an edge is, however the camera is rolled. Of a camera that looks straight
 * down, the map's x is to the right. \param inward Normal of the edge's plane, towards the object,
 * in the map. \param lineOfSight From the camera to the object, in the map [m]. */
BoxSide boxSide(const Eigen::Vector3d& inward, const Eigen::Vector3d& lineOfSight);

/** One measurement of one object as the residuals need it (doc/mathematics.md, 11 and 16). The
 * factor graph keeps it in the robot's frame, so that it stays the same when the robot's pose
 * changes. The map's estimator keeps it in the map, as if the robot were at the map's origin. */
struct BoxMeasurement : MeasuredGeometry
{
  struct Edge
  {
    Eigen::Vector3d normal;         //!< Of the plane through the camera, towards the object
    double sigma = 0;               //!< Of the tangency distance [m]
    double shared = 0;              //!< The part of it by which all views of one side err alike [m]
    BoxSide side = BoxSide::Upper;  //!< Told by the axes of the map, whatever the frame
  };

  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  //!< Of the cuboid, one per column
  /** Of the cuboid's z axis, measured as a support's normal [rad]. It is 0 when there is none. */
  double tiltSigma = 0;

  std::vector<Edge> edges;  //!< The box edges that are used

  bool hasSeed = false;  //!< True when `center` is a measurement of the object's centre
  Eigen::Matrix3d seedWhitening = Eigen::Matrix3d::Identity();  //!< [1/m]

  double weight = 1;  //!< Of all residuals, in (0, 1]
};

/** The measurement in the robot's frame.
 * \param view Made from `detected` with T_map_robot + T_robot_sensor: its sigmas and kinds of
 *  faces are taken over.
 *  \param tiltSigma Standard deviation of a support's normal [rad]; 0: the normal is not used. */
BoxMeasurement measurementFromRobot(
    const DetectedObject& detected,
    const ObjectView& view,
    const mrpt::poses::CPose3D& T_map_robot,
    const mrpt::poses::CPose3D& T_robot_sensor,
    const EstimatorOptions& options,
    double tiltSigma);

/** The measurement in the map. Its cuboid is upright and says nothing of what is up. */
BoxMeasurement measurementInMap(const ObjectView& view, const EstimatorOptions& options);

/** Standard deviation of how far an object is from touching a box edge [m], doc/mathematics.md,
 * (11.6). */
double edgeSigma(
    const ObjectView& view, const ObjectView::Edge& edge, const EstimatorOptions& options);

/** W such that W * (centre - seed) is in sigmas [1/m], doc/mathematics.md, (11.9).
 * \param covariance Of the seed [m^2]. W is for the frame that it is given in. */
Eigen::Matrix3d seedWhitening(const Eigen::Matrix3d& covariance, const EstimatorOptions& options);

}  // namespace quadmap
