#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/random/RandomGenerators.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/maps/FrameLikelihood.h"
#include "quadmap/navigation/LocalizationOptions.h"

namespace quadmap
{
/** Where the robot is according to a particle filter. */
struct LocalizationEstimate
{
  mrpt::poses::CPose3D T_map_robot;
  double share = 0;     //!< Of the weight that is near this pose, in [0, 1]
  double sigma = 0;     //!< Larger standard deviation of x and y [m]
  double yawSigma = 0;  //!< [rad]
  bool isLocalised = false;
};

/** A region of the map in which a robot may be [m]. */
struct StartRegion
{
  Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = Eigen::Vector2d::Zero();
};

/** The smallest upright box around the confirmed objects, with a margin [m].
 * \exception std::invalid_argument If the map has no confirmed object. */
StartRegion regionOf(const CQuadricObjectMap& map, double margin);

/** A particle filter over where a robot is in a map of objects: doc/mathematics.md, section 14.
 * Particles are position and yaw; pitch and roll are those of the odometry, whose frame is z-up.
 *
 * It starts anywhere in a region, and draws a share of its particles from what is seen, so that few
 * are enough and a robot that was carried away is found again. The same calls give the same
 * numbers, whatever the number of threads. (MRPT's own filters draw from a generator that all of a
 * process shares, and need mrpt-slam, which loads a window system.) */
class ParticleLocalization
{
 public:
  /** Every yaw and place of the region is as likely.
   * \param T_odom_robot Pose of the robot at the start.
   * \param threads That weigh, >= 1. */
  ParticleLocalization(
      const LocalizationOptions& options,
      const StartRegion& region,
      const mrpt::poses::CPose3D& T_odom_robot,
      std::size_t threads = 1);

  /** Moves the particles. \param step Motion of the robot since the last call, or the start.
   *  \param T_odom_robot Where it leads to by the odometry: pitch and roll count. */
  void predict(
      const mrpt::poses::CPose3DPDFGaussian& step, const mrpt::poses::CPose3D& T_odom_robot);

  /** Weighs the particles by what is seen from where the robot is now, and draws them anew. */
  void update(const FrameLikelihood& seen);

  /** As of the last update(); of the whole region before. */
  const LocalizationEstimate& estimate() const { return estimate_; }

  const std::vector<LevelPose>& particles() const { return particles_; }

 private:
  std::vector<double> weigh(const FrameLikelihood& seen) const;
  void resample(const std::vector<double>& weights, const FrameLikelihood& seen);
  LevelPose drawnFrom(const FrameLikelihood& seen, const std::vector<double>& pairingSums);
  LocalizationEstimate estimateOf(const std::vector<double>& weights) const;
  Eigen::Vector3d normalVector();

  LocalizationOptions options_;
  std::size_t threads_;
  mrpt::random::CRandomGenerator random_;
  std::vector<LevelPose> particles_;
  double pitch_, roll_;  // of the robot [rad]
  LocalizationEstimate estimate_;
};

}  // namespace quadmap
