#include "quadmap/folders/FrameFolder.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "boxes/BoxReader.h"
#include "frames/FrameImages.h"
#include "frames/FrameRectification.h"
#include "frames/RightHanded.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/RotationVector.h"
#include "quadmap/sensors/BoxCheck.h"
#include "quadmap/sensors/RgbdScan.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** The smallest rotation that takes `up` to +z. */
mrpt::poses::CPose3D uprightRotation(const Eigen::Vector3d& up)
{
  if ((up - Eigen::Vector3d::UnitZ()).norm() < 1e-6) return {};
  const Eigen::Matrix3d R = turnToZ(up).toRotationMatrix();
  return mrpt::poses::CPose3D::FromRotationAndTranslation(R, Eigen::Vector3d::Zero().eval());
}

std::unique_ptr<const BoxReader> findBoxes(
    const std::string& folder, const FrameFolderOptions& options)
{
  if (!options.detections.empty()) return openBoxes(options.detections, options.labels);
  const std::string usual = (fs::path(folder) / "detections").string();
  return fs::is_directory(usual) ? openBoxes(usual, options.labels) : nullptr;
}
}  // namespace

FrameFolder::FrameFolder(FolderContent content, const FrameFolderOptions& options) :
    content_(rightHanded(std::move(content))),
    rectified_(rectifiedCameraOf(content_.camera)),
    boxes_(findBoxes(content_.folder, options))
{
  const auto& camera = content_.camera;
  const bool isScaled =
      rectified_.ncols != camera.color.ncols || rectified_.nrows != camera.color.nrows;
  if (camera.isDistorted() || isScaled)
    rectification_ = std::make_unique<FrameRectification>(camera);
  if (camera.isDistorted())
    content_.notes.push_back(
        content_.folder + ": colour, depth and boxes are rectified, as the lens of " +
        camera.origin + " distorts");
  if (boxes_ && !boxes_->note().empty()) content_.notes.push_back(boxes_->note());
  if (!boxes_)
    content_.notes.push_back(
        content_.folder + ": no detections, hence no boxes (quadmap-slam --detector finds some)" +
        (options.labels.empty() ? "" : "; --labels " + options.labels + " is not used"));
  if (camera.worldUp) turnUp(*camera.worldUp);
}

FrameFolder::FrameFolder(FrameFolder&&) noexcept = default;
FrameFolder::~FrameFolder() = default;

std::size_t FrameFolder::posesCount() const
{
  return static_cast<std::size_t>(std::count_if(
      frames().begin(), frames().end(), [](const auto& f) { return f.T_world_optical; }));
}

std::string FrameFolder::detections() const
{
  return boxes_ ? boxes_->description() : std::string();
}

mrpt::obs::CObservation3DRangeScan::Ptr FrameFolder::scan(std::size_t index) const
{
  const auto& frame = frames().at(index);
  FrameImages images = loadImages(frame, content_);
  if (rectification_)
  {
    images.color = rectification_->color(images.color);
    if (!camera().depth) images.depth = rectification_->depth(images.depth);
  }
  auto scan = makeRgbdScan(frame.time, images.color, images.depth, 1.0 / camera().depthFactor);
  scan->cameraParams = scan->cameraParamsIntensity = rectified_;
  return scan;
}

RecordedFrame FrameFolder::recorded(std::size_t index) const
{
  const auto& frame = frames().at(index);
  if (rectification_ || content_.images) return {scan(index), {}};
  auto jpeg = loadJpeg(frame, camera());
  if (jpeg.empty()) return {scan(index), {}};
  const cv::Mat depth = loadDepth(frame, camera());
  auto scan = makeRgbdScan(frame.time, cv::Mat(), depth, 1.0 / camera().depthFactor);
  scan->cameraParams = scan->cameraParamsIntensity = rectified_;
  return {std::move(scan), std::move(jpeg)};
}

std::string FrameFolder::boxesFile(std::size_t index) const
{
  return boxes_ ? boxes_->fileOf(frames().at(index)) : std::string();
}

bool FrameFolder::boxesAreOfOtherImages() const
{
  return boxes_ && boxes_->isOfOtherImages(frames());
}

CObservationObjects::Ptr FrameFolder::boxes(std::size_t index) const
{
  const auto& frame = frames().at(index);
  auto found = boxes_ ? boxes_->boxes(frame, camera().color) : std::nullopt;
  if (!found) return nullptr;
  auto boxes = CObservationObjects::Create();
  boxes->timestamp = mrpt::Clock::fromDouble(frame.time);
  boxes->sensorLabel = kCameraLabel;
  boxes->cameraParams = rectified_;
  boxes->objects = std::move(*found);
  if (rectification_)
    for (auto& object : boxes->objects) object.box = rectification_->box(object.box);
  return boxes;
}

std::map<std::size_t, std::string> FrameFolder::unusableBoxes(
    std::size_t index, const CObservationObjects& boxes) const
{
  const auto& camera = boxes.cameraParams;
  std::map<std::size_t, std::string> reasons;
  std::vector<std::string> places;
  for (std::size_t i = 0; i < boxes.objects.size(); ++i)
  {
    const auto& object = boxes.objects[i];
    const auto why = whyUnusable(object.box, object.score, camera.ncols, camera.nrows);
    if (!why) continue;
    if (reasons.empty() && boxes_) places = boxes_->placesOf(frames().at(index));
    const std::string place = i < places.size() ? places[i] : boxesFile(index);
    reasons.emplace(i, place + ": " + object.label + " " + *why);
  }
  return reasons;
}

std::optional<mrpt::poses::CPose3D> FrameFolder::T_world_robot(std::size_t index) const
{
  const auto& T_world_optical = frames().at(index).T_world_optical;
  if (!T_world_optical) return std::nullopt;
  return T_zup_world_ + (*T_world_optical + (-T_sensor_optical()));
}

void FrameFolder::turnUp(const Eigen::Vector3d& up) { T_zup_world_ = uprightRotation(up); }

}  // namespace quadmap
