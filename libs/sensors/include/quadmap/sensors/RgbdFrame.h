#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <optional>
#include <string>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** One RGB-D image of one sensor, with everything that the input says about it. */
struct RgbdFrame
{
  std::size_t record = 0;  //!< Index of the scan in its rawlog (0 = first object), for messages
  mrpt::obs::CObservation3DRangeScan::Ptr scan;  //!< Loaded; time stamp and sensorLabel inside
  CObservationObjects::Ptr objects;  //!< Boxes of the same label and time; null without a detector
  bool objectsFromPixelLabels = false;  //!< The boxes were made from pixelLabels
  bool isTurned = false;  //!< The images were turned upside down, as their fy was negative
  std::optional<mrpt::poses::CPose3D> T_odom_robot;  //!< From the rawlog's odometry, any kind
  std::string odometryKind;  //!< Source of T_odom_robot, "CObservationOdometry wheels"
  /** Covariance of T_odom_robot, (x, y, z, yaw, pitch, roll), with zeros where the odometry states
   *  none. Covariances of actions are added up from the first action on. */
  std::optional<mrpt::math::CMatrixDouble66> odometryCovariance;
  std::optional<mrpt::poses::CPose3D> T_world_robot;  //!< From the "ground_truth" poses

  double time() const { return mrpt::Clock::toDouble(scan->timestamp); }  //!< [s]
};

/** Turns boxes, masks and their calibration upside down, from those of a frame that isTurned to
 * those of the recorded images, and back. */
void turnUpsideDown(CObservationObjects& boxes);

}  // namespace quadmap
