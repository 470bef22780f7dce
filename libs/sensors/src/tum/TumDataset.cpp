#include "quadmap/sensors/TumDataset.h"

#include <mrpt/core/format.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/RgbdScan.h"
#include "records/EncodedImage.h"
#include "tum/TumFiles.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** The smallest rotation that takes `up` to +z. */
mrpt::poses::CPose3D uprightRotation(const Eigen::Vector3d& up)
{
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  if ((up - z).norm() < 1e-6) return {};
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(up, z).toRotationMatrix();
  return mrpt::poses::CPose3D::FromRotationAndTranslation(R, Eigen::Vector3d::Zero().eval());
}

cv::Mat loadImage(const std::string& path, int flags, const mrpt::img::TCamera& camera)
{
  std::error_code ignored;  // of names that are too long
  if (!fs::is_regular_file(path, ignored)) throw std::runtime_error(path + ": no such file");
  cv::Mat image;
  try
  {
    image = decodeImageFile(path, flags, RecordLimits().imagePixels);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
  if (image.cols != static_cast<int>(camera.ncols) || image.rows != static_cast<int>(camera.nrows))
    throw std::runtime_error(mrpt::format(
        "%s: is %dx%d, calibration.yaml is for %ux%u", path.c_str(), image.cols, image.rows,
        camera.ncols, camera.nrows));
  return image;
}

std::string findDetections(const std::string& folder, const TumDatasetOptions& options)
{
  const std::string usual = (fs::path(folder) / "detections").string();
  if (options.detections.empty()) return fs::is_directory(usual) ? usual : std::string();
  if (!fs::is_directory(options.detections))
    throw std::runtime_error(options.detections + ": no such folder (of detections)");
  return options.detections;
}

void check(const TumDatasetOptions& o)
{
  if (!(o.maxAssociationDelay > 0))
    throw std::invalid_argument(
        mrpt::format("maxAssociationDelay=%g: must be > 0 s", o.maxAssociationDelay));
  if (!(o.maxPoseGap > 0))
    throw std::invalid_argument(mrpt::format("maxPoseGap=%g: must be > 0 s", o.maxPoseGap));
}
}  // namespace

TumDataset::TumDataset(std::string folder, TumDatasetOptions options) :
    folder_(std::move(folder)), options_(std::move(options))
{
  check(options_);
  if (!fs::is_directory(folder_)) throw std::runtime_error(folder_ + ": no such folder");
  detections_ = findDetections(folder_, options_);
  calibration_ = readTumCalibration((fs::path(folder_) / "calibration.yaml").string());
  frames_ = readTumFrames(folder_, options_.maxAssociationDelay);

  const std::string poses = (fs::path(folder_) / "groundtruth.txt").string();
  if (fs::exists(poses)) trajectory_ = readTumTrajectory(poses);
  requireTrajectoryInOrder();
  if (trajectory_.empty()) notes_.push_back(folder_ + ": no groundtruth.txt, hence no poses");
  if (calibration_.worldUp)
    T_zup_world_ = uprightRotation(*calibration_.worldUp);
  else if (!trajectory_.empty())
    notes_.push_back(folder_ + ": calibration.yaml has no world_up, +z is taken as up");
  if (detections_.empty()) notes_.push_back(folder_ + ": no detections, hence no boxes");
  if (calibration_.camera.distortion != mrpt::img::DistortionModel::none)
    notes_.push_back(folder_ + ": the lens distortion of calibration.yaml is not corrected");
}

void TumDataset::requireTrajectoryInOrder() const
{
  for (std::size_t i = 1; i < trajectory_.size(); ++i)
    if (trajectory_[i].time < trajectory_[i - 1].time)
      throw std::runtime_error(mrpt::format(
          "%s/groundtruth.txt: pose %zu: time goes back from %.6f to %.6f s", folder_.c_str(), i,
          trajectory_[i - 1].time, trajectory_[i].time));
}

mrpt::obs::CObservation3DRangeScan::Ptr TumDataset::scan(std::size_t index) const
{
  const auto& frame = frames_.at(index);
  const auto& camera = calibration_.camera;
  const cv::Mat color = loadImage(frame.color, cv::IMREAD_COLOR, camera);
  const cv::Mat depth = loadImage(frame.depth, cv::IMREAD_UNCHANGED, camera);
  if (depth.type() != CV_16UC1)
    throw std::runtime_error(frame.depth + ": is no depth image (one channel of 16 bits)");

  auto scan = makeRgbdScan(frame.time, color, depth, 1.0 / calibration_.depthFactor);
  scan->cameraParams = scan->cameraParamsIntensity = camera;
  return scan;
}

std::string TumDataset::boxesFile(std::size_t index) const
{
  if (detections_.empty()) return {};
  const std::string name = fs::path(frames_.at(index).color).stem().string() + ".txt";
  return (fs::path(detections_) / name).string();
}

CObservationObjects::Ptr TumDataset::boxes(std::size_t index) const
{
  const std::string file = boxesFile(index);
  if (file.empty() || !fs::exists(file)) return nullptr;
  auto boxes = CObservationObjects::Create();
  boxes->timestamp = mrpt::Clock::fromDouble(frames_.at(index).time);
  boxes->sensorLabel = kCameraLabel;
  boxes->cameraParams = calibration_.camera;
  boxes->objects = readDetections(file);
  return boxes;
}

std::optional<mrpt::poses::CPose3D> TumDataset::T_world_robot(std::size_t index) const
{
  const auto T_tum_optical = poseAt(trajectory_, frames_.at(index).time, options_.maxPoseGap);
  if (!T_tum_optical) return std::nullopt;
  return T_zup_world_ + (*T_tum_optical + (-T_sensor_optical()));
}

}  // namespace quadmap
