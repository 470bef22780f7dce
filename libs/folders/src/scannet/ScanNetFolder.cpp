#include "scannet/ScanNetFolder.h"

#include <mrpt/core/format.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "frames/FolderReader.h"
#include "frames/FrameImages.h"
#include "frames/RigidMatrix.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr double kScanNetDepthFactor = 1000;
constexpr double kScanNetImagesPerSecond = 30;
constexpr double kColumnsOfScanNet = 1296, kRowsOfScanNet = 968;  // of its colour images

/** The matrix of a file in intrinsic/. */
Eigen::Matrix4d matrixOf(const std::string& folder, const char* name)
{
  return readMatrix((fs::path(folder) / "intrinsic" / name).string());
}

/** The pose of a camera on the device, which is the identity where no file tells. */
Eigen::Matrix4d extrinsicOf(const std::string& folder, const char* name)
{
  const std::string file = (fs::path(folder) / "intrinsic" / name).string();
  if (!fs::exists(file)) return Eigen::Matrix4d::Identity();
  const Eigen::Matrix4d T = readMatrix(file);
  if (!isRigid(T)) throw std::runtime_error(file + ": is no rigid transformation");
  return T;
}

mrpt::img::TCamera cameraOf(const Eigen::Matrix4d& K, cv::Size size, const std::string& place)
{
  if (!K.allFinite() || !(K(0, 0) > 0) || K(1, 1) == 0)
    throw std::runtime_error(place + ": the focal length fx must be > 0, fy not 0");
  if (K(0, 1) != 0 || K(1, 0) != 0 || K.row(2) != Eigen::RowVector4d(0, 0, 1, 0))
    throw std::runtime_error(place + ": is no camera matrix");
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(K(0, 0), K(1, 1), K(0, 2), K(1, 2));
  camera.ncols = static_cast<unsigned>(size.width);
  camera.nrows = static_cast<unsigned>(size.height);
  return camera;
}

/** Exports often scale the colour images and leave their calibration as it was. */
void followScaling(FolderContent& content, Eigen::Matrix4d& K, cv::Size size)
{
  constexpr double kFarthestCentre = 0.75;  // as a share of the image; 0.5 is the middle
  if (K(0, 2) <= kFarthestCentre * size.width) return;
  K.row(0) *= size.width / kColumnsOfScanNet;
  K.row(1) *= size.height / kRowsOfScanNet;
  content.notes.push_back(
      content.folder +
      ": intrinsic_color.txt is of images of 1296x968 and is scaled, as these are " +
      std::to_string(size.width) + "x" + std::to_string(size.height));
}

/** The camera of intrinsic/. */
void readCamera(FolderContent& content)
{
  if (!fs::is_directory(fs::path(content.folder) / "intrinsic"))
    throw std::runtime_error(
        content.folder +
        ": has no intrinsic/, which tells the camera; --camera NAME|FILE gives one");
  auto& camera = content.camera;
  camera.origin = "intrinsic/";
  camera.file = content.folder + "/intrinsic";
  camera.depthFactor = kScanNetDepthFactor;
  const cv::Size colorSize = sizeOfImages(content.frames, &FolderFrame::color),
                 depthSize = sizeOfImages(content.frames, &FolderFrame::depth);
  Eigen::Matrix4d K = matrixOf(content.folder, "intrinsic_color.txt");
  followScaling(content, K, colorSize);
  camera.color = cameraOf(K, colorSize, content.folder + "/intrinsic/intrinsic_color.txt");
  DepthCamera depth;
  depth.camera = cameraOf(
      matrixOf(content.folder, "intrinsic_depth.txt"), depthSize,
      content.folder + "/intrinsic/intrinsic_depth.txt");
  depth.T_color_depth = poseOf(
      extrinsicOf(content.folder, "extrinsic_color.txt").inverse() *
      extrinsicOf(content.folder, "extrinsic_depth.txt"));
  camera.depth = depth;
}

void readPoses(FolderContent& content)
{
  content.poses = "pose/";
  for (auto& frame : content.frames)
  {
    const fs::path file =
        fs::path(content.folder) / "pose" / fs::path(frame.color).stem().concat(".txt");
    if (!fs::exists(file)) continue;
    takeMatrixPose(frame, file.string());
    if (frame.T_world_optical && content.camera.posesAreOfDepth)
      frame.T_world_optical = *frame.T_world_optical + (-content.camera.depth->T_color_depth);
  }
}
}  // namespace

bool isScanNetFolder(const std::string& folder)
{
  const auto has = [&](const char* name) { return fs::is_directory(fs::path(folder) / name); };
  return has("color") && has("depth") && (has("pose") || has("intrinsic"));
}

FolderContent readScanNetFolder(const std::string& folder, const FrameFolderOptions& options)
{
  FolderContent content;
  content.folder = folder;
  framesByName(content, "color", "depth", kScanNetImagesPerSecond);
  if (options.camera.empty())
    readCamera(content);
  else
    content.camera = cameraOfFolder(folder, options, "", kScanNetDepthFactor);
  content.camera.posesAreOfDepth = content.camera.depth.has_value();
  content.camera.worldUp = Eigen::Vector3d::UnitZ();  // a given camera is one of another world
  content.camera.upOrigin = "ScanNet";
  if (fs::is_directory(fs::path(folder) / "pose"))
    readPoses(content);
  else
    content.notes.push_back(folder + ": no pose/, hence no poses");
  return content;
}

}  // namespace quadmap
