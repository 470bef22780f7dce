#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/slam/points/PointTypes.h"

namespace quadmap
{
/** What a measurement says beyond what is known. */
template <int D>
struct PointInnovation
{
  PointVector<D> difference;  //!< Measured minus expected, in the robot's frame [m]
  PointMatrix<D> state;       //!< Covariance of what was expected [m^2]
  PointMatrix<D> covariance;  //!< Of the difference, S_ik: the state's and the measurement's [m^2]
};

/** A pose and an object as they are estimated, with their joint uncertainty. */
template <int D>
struct PointBelief
{
  PointPose<D> pose;
  PointVector<D> object;
  PoseStepMatrix<D> poseCovariance;
  Eigen::Matrix<double, kPoseStep<D>, D> poseObject;  //!< Cross covariance
  PointMatrix<D> objectCovariance;
};
template <int D>
PointInnovation<D> innovationOf(const PointBelief<D>& belief, const PointMeasurement<D>& z);

/** Where the robot and the objects are now, with their joint uncertainty: a Kalman filter over the
 * latest pose and all objects. It answers, at every frame, what a measurement would have to look
 * like; the poses of the past are the business of PointGraph.
 *
 * Steps of the state: (shift, turn) of the pose along the map's axes, then a shift per object. */
template <int D>
class PointFilter
{
 public:
  const PointPose<D>& pose() const { return pose_; }
  std::size_t objects() const { return points_.size(); }
  const PointVector<D>& position(std::size_t i) const { return points_[i]; }
  const Eigen::MatrixXd& covariance() const { return P_; }
  PointMatrix<D> objectCovariance(std::size_t i) const;

  /** Starts anew from what is known from elsewhere. */
  void reset(
      const PointPose<D>& pose, std::vector<PointVector<D>> points, Eigen::MatrixXd covariance);

  void predict(const PointOdometry<D>& step);

  PointInnovation<D> innovation(std::size_t object, const PointMeasurement<D>& z) const;

  void update(std::size_t object, const PointMeasurement<D>& z);
  /** A new object, the last one from now on. */
  void add(const PointMeasurement<D>& z);
  /** Later objects move up. */
  void remove(std::size_t object);

 private:
  static constexpr int kP = kPoseStep<D>;
  static Eigen::Index row(std::size_t object) { return kP + D * static_cast<Eigen::Index>(object); }

  PointPose<D> pose_;
  std::vector<PointVector<D>> points_;
  Eigen::MatrixXd P_ = Eigen::MatrixXd::Zero(kP, kP);
};

}  // namespace quadmap
