#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/points/PointTypes.h"

namespace quadmap
{
/** How a measurement differs from what the filter expects: doc/mathematics.md, (18.2). */
template <int D>
struct PointInnovation
{
  PointVector<D> difference;  //!< Measured minus expected, in the robot's frame [m]
  PointMatrix<D> state;       //!< J P J^t, covariance of the expected position [m^2]
  PointMatrix<D> covariance;  //!< S_ik, covariance of the difference [m^2]
};

/** The estimates of a pose and an object, with their joint covariance. */
template <int D>
struct PointBelief
{
  PointPose<D> pose;
  PointVector<D> object;
  PoseIncrementMatrix<D> poseCovariance;
  Eigen::Matrix<double, kPoseIncrement<D>, D> poseObject;  //!< Cross covariance
  PointMatrix<D> objectCovariance;
};
template <int D>
PointInnovation<D> innovationOf(const PointBelief<D>& belief, const PointMeasurement<D>& z);

/** A Kalman filter over the latest pose and all objects, with their joint covariance. At every
 * frame it says where a measurement of an object is to be expected. PointGraph estimates the
 * earlier poses.
 *
 * Increments of the state are (shift, turn) of the pose along the axes of the map, followed by a
 * shift for each object. */
template <int D>
class PointFilter
{
 public:
  const PointPose<D>& pose() const { return pose_; }
  std::size_t objects() const { return points_.size(); }
  const PointVector<D>& position(std::size_t i) const { return points_[i]; }
  const Eigen::MatrixXd& covariance() const { return P_; }
  PointMatrix<D> objectCovariance(std::size_t i) const;

  /** Starts anew from another estimate. */
  void reset(
      const PointPose<D>& pose, std::vector<PointVector<D>> points, Eigen::MatrixXd covariance);

  void predict(const PointOdometry<D>& step);

  PointInnovation<D> innovation(std::size_t object, const PointMeasurement<D>& z) const;

  void update(std::size_t object, const PointMeasurement<D>& z);
  /** Adds a new object, which gets the last index. */
  void add(const PointMeasurement<D>& z);
  /** Removes an object. The indices of later objects decrease by one. */
  void remove(std::size_t object);

 private:
  static constexpr int kP = kPoseIncrement<D>;
  static Eigen::Index row(std::size_t object) { return kP + D * static_cast<Eigen::Index>(object); }

  PointPose<D> pose_;
  std::vector<PointVector<D>> points_;
  Eigen::MatrixXd P_ = Eigen::MatrixXd::Zero(kP, kP);
};

}  // namespace quadmap
