#pragma once

#include <Eigen/Dense>

#include "quadmap/estimation/ObjectShape.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** One residual in its own unit, with its derivatives by increments along the axes of the map:
 * of the robot's pose (doc/mathematics.md, (16.1)) and of the object. */
struct ResidualRow
{
  double r = 0;
  Eigen::Vector3d d_poseTurn = Eigen::Vector3d::Zero(), d_poseMove = Eigen::Vector3d::Zero();
  Eigen::Vector3d d_objectMove = Eigen::Vector3d::Zero(), d_objectTurn = Eigen::Vector3d::Zero();
  Eigen::Vector3d d_logSizes = Eigen::Vector3d::Zero();  //!< By (ln a, ln b, ln c)

  /** Derivative by the state of an upright object. */
  UprightState byUprightState() const
  {
    UprightState J;
    J << d_objectMove, d_objectTurn.z(), d_logSizes;
    return J;
  }
  /** Derivative by the increments (d, w, d ln s) of a free object. */
  Eigen::Matrix<double, 1, 9> byFreeObject() const
  {
    Eigen::Matrix<double, 1, 9> J;
    J << d_objectMove.transpose(), d_objectTurn.transpose(), d_logSizes.transpose();
    return J;
  }
  /** Derivative by the increments (w, d) of the pose. */
  Eigen::Matrix<double, 1, 6> byPose() const
  {
    Eigen::Matrix<double, 1, 6> J;
    J << d_poseTurn.transpose(), d_poseMove.transpose();
    return J;
  }
};

/** The tangency residual with the gradient that its derivatives by a pose need. */
struct TangencyRow : ResidualRow
{
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  //!< R dh/dn_obj, in the map [m]
};

/** Signed distance between a plane and the object that it should touch, r [m] of
 * doc/mathematics.md, (3.5), with the derivatives (3.6) by the object. This is the one place where
 * they are computed.
 * \param n The plane's unit normal, towards the object, in the map.
 * \param distance Of the object's centre from the plane along n [m].
 * \param q Exponent of the object's half width (3.2). */
TangencyRow tangencyRow(
    const Eigen::Vector3d& n, double distance, const ObjectShape& object, double q);

/** r of (3.5) alone [m]: positive when there is a gap, negative when the plane cuts the object.
 * Plane and object are in one frame, and the plane's normal points towards the object. */
double tangencyResidual(const Plane& plane, const Ellipsoid& object, double q = 2.0);

/** Row of a face of a measured cuboid, (11.2): positive when the object is smaller than the face
 * says.
 * \param inward The face's unit normal, towards the object, in the map.
 * \param fromCenter From the cuboid's centre to the object's [m]. \param half Distance of the face
 * from the cuboid's centre [m]. \param q Exponent of the half width that the face touches. */
TangencyRow faceRow(
    const Eigen::Vector3d& inward,
    const Eigen::Vector3d& fromCenter,
    double half,
    const ObjectShape& object,
    double q);

/** Adds the derivatives (16.3) by a pose that carries the plane.
 * \param toObject From the robot to the object's centre [m]. */
void addPoseDerivatives(
    const Eigen::Vector3d& n, const Eigen::Vector3d& toObject, TangencyRow& row);

}  // namespace quadmap
