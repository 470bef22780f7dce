#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "odometry/RecordClock.h"

namespace quadmap
{
/** Interpolates poses of a trajectory while it is read. It keeps only a short piece of it. */
class PoseInterpolator
{
 public:
  /** A pose of a file. */
  struct Stamped
  {
    double time;                           //!< [s]
    mrpt::poses::CPose3DPDFGaussian pose;  //!< Its covariance may be zero, which means unknown
    std::size_t record;                    //!< Index in its file
  };

  /** Adds the next pose.
   *  \return The poses before that were strays: see RecordClock. They are then forgotten.
   *  \exception std::runtime_error If the pose cannot be used, or is earlier than the pose before
   *  although that one is no stray. */
  std::vector<StrayRecord> add(const Stamped& pose);

  bool empty() const { return poses_.empty(); }
  /** Time up to which the trajectory is known [s]; -infinity before. The last poses do not count
   * as long as they may be strays. */
  double latest() const { return clock_.latest(); }
  /** Whether the pose at this time [s] is known without any later pose. */
  bool reaches(double time) const;

  /** The pose at a time [s], interpolated between its neighbours: rotation by slerp, position
   * linearly. The covariance has its share of what the step between them adds; where nothing adds
   * up (as with true poses), it is interpolated linearly. The pose is nothing outside the
   * trajectory, and when the neighbours are more than `maxGap` [s] apart. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> at(double time, double maxGap) const;

  /** Forgets what no pose from this time on needs [s]. */
  void forgetBefore(double time);

 private:
  RecordClock clock_;
  std::deque<Stamped> poses_;  // in the order of time
};

/** Why a pose or motion of a file cannot be one: numbers that are not finite or absurd, no
 * rotation, or a covariance that is none.
 */
std::optional<std::string> whyUnusable(const mrpt::poses::CPose3DPDFGaussian& pose);

}  // namespace quadmap
