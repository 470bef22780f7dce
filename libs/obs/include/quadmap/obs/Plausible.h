#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <optional>
#include <string>

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
// What the numbers of a file may be. Beyond these limits is nothing that a robot meets, and what is
// computed from it overflows or means nothing, often much later. Whatever reads such numbers asks
// here, and so does whatever writes them. NaN is never within a limit.

/** Poses and objects farther from the origin are none [m]: ten times the largest coordinates of
 * maps (UTM). */
inline constexpr double kFarthestPosition = 1e8;
/** Nothing on a robot is farther from its origin [m]. */
inline constexpr double kFarthestOnRobot = 1000;
/** Full sizes of objects [m]: thinner than paper, and larger than a town. */
inline constexpr double kSmallestSize = 1e-6, kLargestSize = 1e4;
/** Of angles that need not be within a turn [rad]: a robot that turned on the spot for a day. */
inline constexpr double kLargestAngle = 1e5;
/** Latest time [s]: the year 2286, if times count from 1970. The 64 bits in which a rawlog counts
 * steps of 100 ns end before 1e12 s. */
inline constexpr double kLatestTime = 1e10;
/** Coefficients of a lens [-]. */
inline constexpr double kLargestCoefficient = 1e3;

/** Whether a matrix is a rotation. Files round. */
bool isRotation(const Eigen::Matrix3d& R);

// Why a value cannot be what it should be, as a phrase to follow its name: "is 1e+300 m away, which
// is absurd". Nothing when it can.

/** \param farthest Most distance from the origin [m]. */
std::optional<std::string> whyNoPose(
    const mrpt::poses::CPose3D& pose, double farthest = kFarthestPosition);

/** The quaternion of a rotation, whose length is 1 but for the digits that a file has. Another
 * length is that of a number that was cut, or of columns in another order. */
std::optional<std::string> whyNoUnitQuaternion(const Eigen::Quaterniond& q);

/** \param size Full sizes of an object [m]. */
std::optional<std::string> whyNoSize(const Eigen::Vector3d& size);

/** An object of a map or of a truth. */
std::optional<std::string> whyNoObject(const Ellipsoid& object);

/** Focal lengths, centre and distortion, as far as numbers beyond them overflow. Whether a camera
 * that is merely odd can be used is told by requireCalibration(). */
std::optional<std::string> whyNoCalibration(const mrpt::img::TCamera& camera);

}  // namespace quadmap
