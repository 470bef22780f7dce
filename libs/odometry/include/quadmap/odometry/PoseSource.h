#pragma once

#include <string>

namespace quadmap
{
/** Where the poses of the frames come from. */
enum class PoseSource
{
  Auto,         //!< What surveyOdometry() finds; otherwise the rawlog's odometry
  Rawlog,       //!< The rawlog's odometry
  Visual,       //!< Visual odometry from the images
  GroundTruth,  //!< The rawlog's "ground_truth" poses
  Graph         //!< A pose graph of another run or program
};

/** The source of the name auto, rawlog, visual, ground-truth or graph:FILE.
 * \exception std::invalid_argument For any other name. */
PoseSource poseSourceFrom(const std::string& name);
std::string nameOf(PoseSource source);

}  // namespace quadmap
