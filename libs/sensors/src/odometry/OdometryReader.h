#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "odometry/PoseInterpolator.h"

namespace quadmap
{
/** Turns the odometry of a rawlog, of any kind, into poses of the robot. It uses one kind
 * throughout, because poses of two sources are in different coordinate frames. */
class OdometryReader
{
 public:
  /** \param kind The kind to use; when it is empty, the first that appears. */
  explicit OdometryReader(std::string kind) : kind_(std::move(kind)) {}

  /** Reads a record, which may have nothing to do with poses.
   *  \param record Its index.
   *  \return The records of the same source that have to be dropped.
   *  \exception std::runtime_error If the pose cannot be used or time goes backwards. */
  std::vector<StrayRecord> read(std::size_t record, const mrpt::obs::CObservation& observation);

  /** Reads the motion of an action. Actions without a motion are legal. */
  void read(const mrpt::obs::CActionCollection& actions);

  const std::string& kind() const { return kind_; }  //!< Class and label; empty before the first
  const std::vector<std::string>& kinds() const
  {
    return kinds_;
  }  //!< All kinds so far, in their order
  bool countsActions() const { return countsActions_; }
  const std::string& ignoredKind() const
  {
    return ignoredKind_;
  }  //!< A kind that is not used, if any

  const mrpt::poses::CPose3DPDFGaussian& sumOfActions() const { return sumOfActions_; }
  const PoseInterpolator& odometry() const { return odometry_; }
  const PoseInterpolator& truth() const { return truth_; }
  void forgetOlderThan(double age);  //!< Of each trajectory, by the time of its own last pose [s]
  void forgetBefore(double time);    //!< Forgets what no pose from this time on needs [s]

 private:
  bool accept(const std::string& kind);

  std::string kind_, ignoredKind_;
  std::vector<std::string> kinds_;
  bool countsActions_ = false;
  mrpt::poses::CPose3DPDFGaussian sumOfActions_;
  PoseInterpolator odometry_, truth_;
};

}  // namespace quadmap
