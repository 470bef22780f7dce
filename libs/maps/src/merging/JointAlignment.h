#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap
{
/** Shift (x, y, z [m]) and yaw [rad] of the frame of one z-up map in another one. */
using ShiftAndYaw = Eigen::Vector4d;

/** The state of an upright object in the other map's frame -> that in the own one: x = D y + shift,
 * an object's axes keeping their names. */
struct StateShift
{
  explicit StateShift(const ShiftAndYaw& T_own_other);

  UprightState state(const UprightState& y) const { return D * y + c; }
  UprightState back(const UprightState& x) const { return D.transpose() * (x - c); }
  InformationPrior information(const InformationPrior& other) const;

  UprightCovariance D = UprightCovariance::Identity();
  UprightState c = UprightState::Zero();
};

/** Derivative of D y + c by the shift and yaw. */
Eigen::Matrix<double, 7, 4> byShiftAndYaw(const StateShift& shift, const UprightState& y);

/** What one map knows of an object: its state in the map's frame and the information of the
 * measurements, without the label's prior. */
struct KnownState
{
  UprightState state = UprightState::Zero();
  InformationPrior known;
  bool hasHeading = false;
};

/** One object that two maps have. */
struct KnownPair
{
  KnownState own, other;  //!< Each in the frame of its map
  LabelProperties label;
};

/** Two maps as one. */
struct JointEstimate
{
  struct Object
  {
    UprightState state;      //!< In the own map's frame
    InformationPrior known;  //!< What both maps know, given where the other one is
    /** What the uncertainty of where the other map is adds to the object's covariance. It is
     * common to all objects. */
    UprightCovariance sharedError;
    double distance = 0;  //!< Mahalanobis distance between what both maps say, chi of 7 numbers
  };
  ShiftAndYaw T_own_other = ShiftAndYaw::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();  //!< Of T_own_other
  std::vector<Object> objects;                               //!< One for each pair
};

/** Estimates where the other map is, and the objects that both have, together: doc/mathematics.md,
 * section "Two maps as one". The own map's frame is exact.
 * \param pairs At least one. \param start Nearly the place of the other map. */
JointEstimate estimateJointly(
    const std::vector<KnownPair>& pairs, const ShiftAndYaw& start, const EstimatorOptions& options);

}  // namespace quadmap
