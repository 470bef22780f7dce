#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <deque>
#include <optional>

namespace quadmap
{
/** A short piece of a trajectory, as it comes in. */
class PoseTrack
{
 public:
  /** \param time [s] \param pose Its covariance may be zero: unknown.
   *  \exception std::runtime_error If the pose is not finite or its time lies before that of the
   *  pose before. */
  void add(double time, const mrpt::poses::CPose3DPDFGaussian& pose);

  bool empty() const { return poses_.empty(); }
  /** True when no later pose is needed to know the one at this time [s]. */
  bool reaches(double time) const;

  /** Interpolated (slerp; the covariance linearly) between the neighbours; nothing outside the
   * track or when the neighbours are more than `maxGap` [s] apart. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> at(double time, double maxGap) const;

  /** Forgets what poses at this time [s] or later do not need. */
  void forgetBefore(double time);

 private:
  struct Stamped
  {
    double time;  // [s]
    mrpt::poses::CPose3DPDFGaussian pose;
  };
  std::deque<Stamped> poses_;  // in the order of time
};

/** All six numbers finite? */
bool isFinite(const mrpt::poses::CPose3D& pose);

}  // namespace quadmap
