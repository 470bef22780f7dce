#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** A pose and its time. */
struct StampedPose
{
  double time = 0;            //!< [s], usually since 1970
  mrpt::poses::CPose3D pose;  //!< T_world_body; the owner of the file says which body
};

using Trajectory = std::vector<StampedPose>;

/** Reads lines of `time tx ty tz qx qy qz qw` in the order of the file (the format of TUM RGB-D;
 * '#' starts a comment). Quaternions are normalised. \exception std::runtime_error For a file that
 * cannot be read, a wrong number of columns, a value that is no finite number, or a zero
 * quaternion. The message names file and line. */
Trajectory readTumTrajectory(const std::string& path);

/** The same for interpolation, of a file in which single lines may be wrong: poses whose times
 * rise. \param unusable Receives why lines are left out, each with file and line: they cannot be
 * read, their time is out of order, or the line before has another pose at it. A line that is there
 * twice is read once. \exception std::runtime_error For a file that cannot be read, or has too many
 * such lines. */
Trajectory readTrajectoryInOrder(const std::string& path, std::vector<std::string>& unusable);

/** Writes times with microseconds and everything else with nine decimals. The file has a temporary
 * name until it is complete. \exception std::runtime_error If it cannot be written. */
void writeTumTrajectory(const std::string& path, const Trajectory& trajectory);

/** The pose at a time between two samples. Positions are interpolated linearly, rotations by slerp.
 * \param trajectory Sorted by time.
 * \param maxGap Longest time between the two samples [s].
 * \return Nothing before the first sample, after the last one, and in longer gaps. */
std::optional<mrpt::poses::CPose3D> poseAt(
    const Trajectory& trajectory, double time, double maxGap);

}  // namespace quadmap
