#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <deque>
#include <optional>

namespace quadmap
{
/** Interpolates poses of a trajectory while it is read. It keeps only a short piece of it. */
class PoseInterpolator
{
 public:
  /** Adds the next pose.
   *  \param time Time of the pose [s].
   *  \param pose Its covariance may be zero, which means unknown.
   *  \exception std::runtime_error If the pose is not finite, or earlier than the pose before. */
  void add(double time, const mrpt::poses::CPose3DPDFGaussian& pose);

  bool empty() const { return poses_.empty(); }
  double latest() const;  //!< Time of the last pose [s]; -infinity when there is none
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
  struct Stamped
  {
    double time;  // [s]
    mrpt::poses::CPose3DPDFGaussian pose;
  };
  std::deque<Stamped> poses_;  // in the order of time
};

}  // namespace quadmap
