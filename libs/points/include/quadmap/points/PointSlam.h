#pragma once

#include <memory>
#include <vector>

#include "quadmap/points/PointOptions.h"
#include "quadmap/points/PointTypes.h"

namespace quadmap
{
/** What PointSlam found out. */
template <int D>
struct PointResult
{
  std::vector<PointPose<D>> poses;
  std::vector<PointObject<D>> objects;
  std::vector<std::vector<PointDecision>> decisions;  //!< By pose and measurement
  int rounds = 0;                                     //!< Rounds that finish() took
  double lastMove = 0;     //!< Largest move of a pose in the last round [m]
  bool converged = false;  //!< The last round changed no association and hardly moved a pose
};

template <int D>
class PointSlamImpl;

/** Finds the objects behind the points that a robot measured, without being told which point is
 * which object, and corrects the robot's trajectory by them. It is a nonparametric pose graph (Mu
 * et al., IROS 2016), in the plane (D = 2) or in space (D = 3): doc/mathematics.md, section 18.
 *
 * addFrame() works online. A measurement joins an object when it is clear which one it is, given
 * the uncertainty of the robot's pose. Otherwise it starts an object of its own. Objects that were
 * mapped twice because of drift (doubles) become one when several such pairs fit at once. finish()
 * estimates poses and objects anew, in turn with the associations. The class uses one thread, and
 * the same input gives the same result. */
template <int D>
class PointSlam
{
 public:
  /** \param posesGiven The poses are exactly where the odometry says.
   *  \param visible Says where the sensor looks. When it is empty, the measurements themselves show
   *  where the sensor looks and how often it sees what is there.
   *  \param detectionProbability Probability that a frame shows an object that is `visible`, in
   *  (0, 1). */
  explicit PointSlam(
      const PointOptions& options,
      bool posesGiven = false,
      PointVisibility<D> visible = {},
      double detectionProbability = 0.7);
  ~PointSlam();

  /** \param step Motion since the frame before. The first frame ignores it: its pose is `origin`.
   */
  void addFrame(
      const PointOdometry<D>& step,
      const std::vector<PointMeasurement<D>>& measurements,
      const PointPose<D>& origin = {});

  /** Estimates everything anew. Call it once, after the last frame. */
  void finish();

  /** The estimate so far. Its objects include those that are not confirmed. */
  PointResult<D> result() const;
  const PointPose<D>& pose() const;  //!< Pose of the last frame

 private:
  std::unique_ptr<PointSlamImpl<D>> impl_;
};

}  // namespace quadmap
