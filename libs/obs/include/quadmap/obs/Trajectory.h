#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
struct StampedPose
{
  double time = 0;            //!< [s], usually since 1970
  mrpt::poses::CPose3D pose;  //!< T_world_body; which body, the owner of the file says
};

using Trajectory = std::vector<StampedPose>;

/** Reads `time tx ty tz qx qy qz qw` lines (TUM RGB-D; '#' starts a comment), in the file's order.
 * Quaternions are normalised.
 * \exception std::runtime_error For an unreadable file, a wrong number of columns, something that
 * is not a finite number, a zero quaternion; names file and line. */
Trajectory readTumTrajectory(const std::string& path);

/** Time with microseconds, the rest with nine decimals. Written to a temporary name and renamed
 * when complete. \exception std::runtime_error */
void writeTumTrajectory(const std::string& path, const Trajectory& trajectory);

/** The pose at a time between two samples: linear in position, slerp in rotation.
 * \param trajectory Sorted by time.
 * \param maxGap The two samples are at most this far apart [s].
 * \return Nothing before the first and after the last sample, and in longer gaps. */
std::optional<mrpt::poses::CPose3D> poseAt(
    const Trajectory& trajectory, double time, double maxGap);

}  // namespace quadmap
