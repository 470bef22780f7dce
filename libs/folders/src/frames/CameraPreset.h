#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadmap/base/OptionGroup.h"
#include "quadmap/folders/FolderCamera.h"

namespace quadmap
{
/** Section [camera] of a file with a camera. */
struct CameraPreset : public OptionGroup
{
  std::string folders;
  int width = 640, height = 480;
  std::array<double, 4> color{0, 0, 0, 0};          //!< fx, fy, cx, cy [px]
  std::array<double, 5> distortion{0, 0, 0, 0, 0};  //!< k1, k2, p1, p2, k3
  double depthFactor = 0;                           //!< 0: as usual in the layout of the folder
  int noDepth = 0;
  int depthWidth = 0, depthHeight = 0;      //!< [px]; 0: those of the colour images
  std::array<double, 4> depth{0, 0, 0, 0};  //!< As `color`; zero when registered
  Eigen::Matrix4d T_color_depth = Eigen::Matrix4d::Identity();
  bool posesAreOfDepth = false;
  std::array<double, 3> worldUp{0, 0, 0};  //!< Zero: not known

  /** Centres that the file does not have are those of the images: cx = (width - 1) / 2,
   *  depthCx = (depthWidth - 1) / 2. \exception std::runtime_error If it cannot be read.
   *  \exception std::invalid_argument For wrong values. Both messages start with its name. */
  static CameraPreset fromFile(const std::string& path);

  FolderCamera camera(const std::string& origin) const;

  /** Words in the names of folders with recordings of this camera. */
  std::vector<std::string> folderWords() const;

 private:
  void describe(OptionList& list) override;

  /** Width and height of the depth images [px]. */
  std::pair<int, int> depthSize() const;

  /** The camera of depth images that have a pose or a size of their own. */
  std::optional<DepthCamera> depthCamera() const;
};

}  // namespace quadmap
