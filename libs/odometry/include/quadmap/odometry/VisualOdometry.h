#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/odometry/VisualOdometryOptions.h"

namespace quadmap
{
/** What visual odometry did. */
struct VisualOdometryCounts
{
  std::size_t frames = 0;         //!< Images that were given
  std::size_t byFlow = 0;         //!< Images whose corners were followed from a keyframe
  std::size_t byDescriptors = 0;  //!< Images matched by descriptors because flow failed
  std::size_t failed = 0;         //!< Images without a pose
  std::size_t keyframes = 0;
  std::size_t gaps = 0;  //!< New starts, without knowing the motion in between
};

/** Motion of a hand-held RGB-D camera from its images alone: doc/mathematics.md, section 15.
 * Corners of a keyframe are followed by optical flow or, when that fails, matched by descriptors.
 * The motion that most of them agree on is refined on pixels, depth and surfaces together.
 *
 * The same images give the same poses, whatever the number of threads. */
class VisualOdometry
{
 public:
  /** \param T_map_first Pose of the robot at the first usable image. */
  VisualOdometry(
      const VisualOdometryOptions& options, const mrpt::poses::CPose3D& T_map_first = {});
  ~VisualOdometry();

  /** \param scan The next image. All images are of one camera and in the order of time.
   *  \return T_map_robot, or nothing when the image shows too little or something unexpected. */
  std::optional<mrpt::poses::CPose3D> add(const mrpt::obs::CObservation3DRangeScan& scan);

  /** Motion of the robot from the latest image with a pose at the last call to the latest one now,
   *  with its covariance (x, y, z, yaw, pitch, roll). The first call returns nothing. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> takeStep();

  const VisualOdometryCounts& counts() const;

  /** What went wrong since the last call, one line each. */
  std::vector<std::string> takeWarnings();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
