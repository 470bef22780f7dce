#pragma once

#include <string>

namespace quadmap
{
/** Sensor labels of the CObservationRobotPose records in our rawlogs. */
inline const std::string kOdometryLabel = "odometry";
inline const std::string kGroundTruthLabel = "ground_truth";  //!< The true pose, not odometry

/** Where the boxes of a rawlog live: NAME.rawlog -> NAME.objects.rawlog, with .gz at the end when
 * the rawlog has it. */
std::string objectsFileOf(const std::string& rawlog);

/** Where the external images of a rawlog are written: NAME.rawlog -> NAME_Images. */
std::string imagesFolderOf(const std::string& rawlog);

/** Where the external images of a rawlog are: the first that exists of NAME_Images, NAME_images,
 * NAME_IMAGES and Images beside it (MRPT's convention), else the rawlog's own folder. */
std::string findImagesFolder(const std::string& rawlog);

}  // namespace quadmap
