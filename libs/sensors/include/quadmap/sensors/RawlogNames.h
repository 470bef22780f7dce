#pragma once

#include <string>

namespace quadmap
{
/** Sensor labels of the CObservationRobotPose records in our rawlogs. */
inline const std::string kOdometryLabel = "odometry";
inline const std::string kGroundTruthLabel = "ground_truth";  //!< The true pose, not odometry

/** The file with the boxes of a rawlog: NAME.objects.rawlog of NAME.rawlog, with .gz at the end
 * when the rawlog has it. */
std::string objectsFileOf(const std::string& rawlog);

/** The folder to write the external images of a rawlog to: NAME_Images of NAME.rawlog. */
std::string imagesFolderOf(const std::string& rawlog);

/** The folder to read the external images of a rawlog from, by MRPT's convention: the first that
 * exists of NAME_Images, NAME_images, NAME_IMAGES and Images beside the rawlog, else its own
 * folder.
 */
std::string findImagesFolder(const std::string& rawlog);

}  // namespace quadmap
