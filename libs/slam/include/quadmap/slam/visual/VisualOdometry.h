#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/slam/visual/VisualOdometryOptions.h"

namespace quadmap
{
/** What visual odometry did. */
struct VisualOdometryCounts
{
  std::size_t frames = 0;         //!< Seen
  std::size_t byFlow = 0;         //!< Followed corner by corner from a keyframe
  std::size_t byDescriptors = 0;  //!< Recognised by descriptors, because flow did not do
  std::size_t failed = 0;         //!< Have no pose
  std::size_t keyframes = 0;
  std::size_t gaps = 0;  //!< Bridged without knowing the motion
};

/** Motion of a hand-held RGB-D camera from its images alone (doc/mathematics.md): corners followed
 * from a keyframe by optical flow or, when that fails, recognised by descriptors; the motion most
 * of them agree on; refined on pixels, depth and surfaces together.
 *
 * The same images give the same poses, whatever the number of threads. */
class VisualOdometry
{
 public:
  /** \param T_map_first Where the robot is at the first usable image. */
  VisualOdometry(
      const VisualOdometryOptions& options, const mrpt::poses::CPose3D& T_map_first = {});
  ~VisualOdometry();

  /** \param scan The next image of the one camera, later than those before.
   *  \return T_map_robot, or nothing: the image shows too little, or not what could be expected. */
  std::optional<mrpt::poses::CPose3D> add(const mrpt::obs::CObservation3DRangeScan& scan);

  /** Motion of the robot from the image of the last call of this method to the latest image, both
   * with a pose, with its covariance (x, y, z, yaw, pitch, roll). Nothing at the first call. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> takeStep();

  const VisualOdometryCounts& counts() const;

  /** What went wrong since the last call, one line each. */
  std::vector<std::string> takeWarnings();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
