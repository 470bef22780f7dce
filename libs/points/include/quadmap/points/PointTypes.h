#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
template <int D>
using PointVector = Eigen::Matrix<double, D, 1>;
template <int D>
using PointMatrix = Eigen::Matrix<double, D, D>;

/** How many numbers an increment of a pose has: a shift, then a turn. */
template <int D>
constexpr int kPoseIncrement = D == 2 ? 3 : 6;

/** How many numbers a turn has: an angle in the plane, a rotation vector in space [rad]. */
template <int D>
constexpr int kTurn = D == 2 ? 1 : 3;

template <int D>
using PoseIncrementMatrix = Eigen::Matrix<double, kPoseIncrement<D>, kPoseIncrement<D>>;
template <int D>
using TurnVector = Eigen::Matrix<double, kTurn<D>, 1>;

/** Pose of a robot in the plane (D = 2) or in space (D = 3): x_map = R x_robot + t. */
template <int D>
struct PointPose
{
  PointMatrix<D> R = PointMatrix<D>::Identity();
  PointVector<D> t = PointVector<D>::Zero();  //!< [m]

  PointPose operator*(const PointPose& b) const { return {R * b.R, R * b.t + t}; }
  PointVector<D> operator*(const PointVector<D>& p) const { return R * p + t; }
  PointPose inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
};

/** The rotation by an angle or by a rotation vector [rad]. turnOf() is the inverse. */
template <int D>
PointMatrix<D> rotationBy(const TurnVector<D>& turn);
template <int D>
TurnVector<D> turnOf(const PointMatrix<D>& R);

/** The matrix M(v) with w x v = M(v) w, which says how a small turn w moves the point v. */
template <int D>
Eigen::Matrix<double, D, kTurn<D>> movedByTurn(const PointVector<D>& v);

/** Motion from one pose to the next, by odometry. */
template <int D>
struct PointOdometry
{
  PointPose<D> T_from_to;
  /** Covariance of the position along the axes of `from` [m^2], then of the turn along the axes of
   *  `to` [rad^2]; (x, y, angle) in the plane. It is positive definite. */
  PoseIncrementMatrix<D> covariance = PoseIncrementMatrix<D>::Identity();
};

/** The measured position of one thing. */
template <int D>
struct PointMeasurement
{
  PointVector<D> position = PointVector<D>::Zero();        //!< In the robot's frame [m]
  PointMatrix<D> covariance = PointMatrix<D>::Identity();  //!< [m^2], positive definite
  std::string label;
  std::optional<std::uint32_t> instance = std::nullopt;  //!< Set when associations are given
};

/** Which object a measurement was associated with. */
struct PointDecision
{
  std::optional<std::size_t> object;  //!< Index of the object; empty for clutter
  bool startedObject = false;
  double logPosterior = 0;        //!< ln P of this choice, over all alternatives
  double logPosteriorSecond = 0;  //!< The same of the best other choice, or -infinity
};

/** An estimated object. */
template <int D>
struct PointObject
{
  PointVector<D> position = PointVector<D>::Zero();        //!< In the map [m]
  PointMatrix<D> covariance = PointMatrix<D>::Identity();  //!< [m^2]
  std::map<std::string, unsigned> labelCounts;
  unsigned observations = 0;
  std::optional<std::uint32_t> instance = std::nullopt;
  double existenceLogOdds = 0;
  bool confirmed = false;  //!< Enough evidence to be reported

  std::string label() const { return mostFrequentLabel(labelCounts); }
};

/** Whether the sensor, from the pose with this index, should have seen something at a position in
 * the robot's frame [m]. */
template <int D>
using PointVisibility = std::function<bool(const PointVector<D>& position, std::size_t pose)>;

}  // namespace quadmap
