#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "PoseTrack.h"

namespace quadmap
{
/** Turns whatever a rawlog has for odometry into poses of the robot. One kind is used throughout:
 * poses of two sources live in different frames. */
class OdometryReader
{
 public:
  /** \param kind The one to use; empty: the first that appears. */
  explicit OdometryReader(std::string kind) : kind_(std::move(kind)) {}

  /** \return False when the observation has nothing to do with poses.
   *  \exception std::runtime_error If the pose is not finite or time goes backwards. */
  bool read(const mrpt::obs::CObservation& observation);

  /** The increment of an action; actions without movement are legal. */
  void read(const mrpt::obs::CActionCollection& actions);

  const std::string& kind() const { return kind_; }  //!< Class and label; empty while unknown
  const std::vector<std::string>& kinds() const { return kinds_; }  //!< Seen, in their order
  bool countsActions() const { return countsActions_; }
  const std::string& ignoredKind() const { return ignoredKind_; }  //!< A second source, if any

  const mrpt::poses::CPose3DPDFGaussian& sumOfActions() const { return sumOfActions_; }
  const PoseTrack& track() const { return track_; }
  const PoseTrack& truth() const { return truth_; }
  void forgetBefore(double time);  //!< What poses at this time [s] or later do not need

 private:
  bool accept(const std::string& kind);

  std::string kind_, ignoredKind_;
  std::vector<std::string> kinds_;
  bool countsActions_ = false;
  mrpt::poses::CPose3DPDFGaussian sumOfActions_;
  PoseTrack track_, truth_;
};

}  // namespace quadmap
