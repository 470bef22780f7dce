#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
template <int D>
using PointVector = Eigen::Matrix<double, D, 1>;
template <int D>
using PointMatrix = Eigen::Matrix<double, D, D>;

/** Numbers of a step of a pose: a shift, then a turn. */
template <int D>
constexpr int kPoseStep = D == 2 ? 3 : 6;

/** Numbers of a turn: an angle in the plane, a rotation vector in space [rad]. */
template <int D>
constexpr int kTurn = D == 2 ? 1 : 3;

template <int D>
using PoseStepMatrix = Eigen::Matrix<double, kPoseStep<D>, kPoseStep<D>>;
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

/** The rotation by an angle or a rotation vector [rad], and back. */
template <int D>
PointMatrix<D> rotationBy(const TurnVector<D>& turn);
template <int D>
TurnVector<D> turnOf(const PointMatrix<D>& R);

/** The matrix M(v) with w x v = M(v) w: how a small turn w moves the point v. */
template <int D>
Eigen::Matrix<double, D, kTurn<D>> movedByTurn(const PointVector<D>& v);

/** Motion between two successive poses, by odometry. */
template <int D>
struct PointOdometry
{
  PointPose<D> T_from_to;
  /** Of the position along the axes of `from` [m^2], then of the turn along the axes of `to`
   *  [rad^2]: (x, y, angle) in the plane. Positive definite. */
  PoseStepMatrix<D> covariance = PoseStepMatrix<D>::Identity();
};

/** One thing that was seen. */
template <int D>
struct PointMeasurement
{
  PointVector<D> position = PointVector<D>::Zero();        //!< In the robot's frame [m]
  PointMatrix<D> covariance = PointMatrix<D>::Identity();  //!< [m^2], positive definite
  std::string label;
  std::optional<std::uint32_t> instance = std::nullopt;  //!< When associations are given
};

/** What a measurement was taken for. */
struct PointDecision
{
  std::optional<std::size_t> object;  //!< Index into the objects; nothing: clutter, or waiting
  bool startedObject = false;
  double logPosterior = 0;        //!< Of this choice, normalised over all alternatives
  double logPosteriorSecond = 0;  //!< Of the best other one; -infinity when there is none
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

  std::string label() const;  //!< The most frequent one; ties go to the alphabetically first
};

/** Should the sensor have seen something at a position in the robot's frame [m], from the pose with
 * this index? */
template <int D>
using PointVisibility = std::function<bool(const PointVector<D>& position, std::size_t pose)>;

}  // namespace quadmap
