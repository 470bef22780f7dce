#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** A depth camera whose images are not registered to the colour images, or have another size. */
struct DepthCamera
{
  mrpt::img::TCamera camera;           //!< Without distortion
  mrpt::poses::CPose3D T_color_depth;  //!< Its pose in the colour camera, both optical frames
};

/** The camera of a recording in a folder. */
struct FolderCamera
{
  /** Where this is from, for messages: "calibration.yaml", "camera fr1". A file that the user names
   * has its path here, too. */
  std::string origin;
  std::string file;           //!< The path of that, if it is a file of the recording or of the user
  mrpt::img::TCamera color;   //!< Calibration of the images as they are in the files
  double depthFactor = 5000;  //!< Depth [m] = pixel value / depthFactor
  /** A pixel value that means no measurement, as 0 always does. */
  std::uint16_t noDepth = 0;
  /** Set when the depth images are not registered to the colour images, or have another size. */
  std::optional<DepthCamera> depth;
  bool posesAreOfDepth = false;            //!< The poses of the recording are those of `depth`
  std::optional<Eigen::Vector3d> worldUp;  //!< Unit vector in the world of the recording's poses
  std::string upOrigin;  //!< Where worldUp is from; empty: from where the camera is

  bool isDistorted() const { return color.distortion != mrpt::img::DistortionModel::none; }
};

/** Reads a camera from an INI file with a section [camera], such as those in share/quadmap/cameras,
 * which document the keys.
 * \param what The name of one of these ("fr1"), or the path of a file, which ends in .ini.
 * \exception std::runtime_error If it cannot be read. A wrong name lists the known ones.
 * \exception std::invalid_argument For wrong values. All messages start with its name. */
FolderCamera cameraPreset(const std::string& what);

/** The names of all cameras in share/quadmap/cameras, in alphabetical order. */
std::vector<std::string> cameraPresetNames();

/** The name of the camera that the name of a folder stands for, such as fr1 for
 * rgbd_dataset_freiburg1_xyz. The folders above are looked at as well. */
std::optional<std::string> presetOfFolder(const std::string& folder);

/** The colour camera with images of another size. \exception std::runtime_error If the proportions
 * are others. The message starts with the camera's origin. */
mrpt::img::TCamera scaledTo(const FolderCamera& camera, unsigned width, unsigned height);

}  // namespace quadmap
