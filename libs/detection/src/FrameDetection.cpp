#include "quadmap/detection/FrameDetection.h"

#include <opencv2/imgproc.hpp>

namespace quadmap
{
mrpt::img::CImage recordedImage(const RgbdFrame& frame)
{
  const auto& scan = *frame.scan;
  cv::Mat image = scan.intensityImage.asCvMatRef();
  const cv::Size size(
      static_cast<int>(scan.cameraParams.ncols), static_cast<int>(scan.cameraParams.nrows));
  if (image.size() != size)
  {
    cv::Mat scaled;
    cv::resize(image, scaled, size, 0, 0, cv::INTER_AREA);
    image = scaled;
  }
  if (frame.isTurned)
  {
    cv::Mat turned;
    cv::flip(image, turned, 0);
    image = turned;
  }
  return {image, mrpt::img::SHALLOW_COPY};
}

CObservationObjects::Ptr detectObjects(const RgbdFrame& frame, Detector& detector)
{
  const auto& scan = *frame.scan;
  if (!scan.hasIntensityImage || scan.intensityImage.isEmpty()) return nullptr;
  auto boxes = CObservationObjects::Create();
  boxes->timestamp = scan.timestamp;
  boxes->sensorLabel = scan.sensorLabel;
  boxes->sensorPose = scan.sensorPose;
  boxes->cameraParams = scan.cameraParams;
  if (frame.isTurned) turnUpsideDown(*boxes);
  boxes->objects = detector.detect(recordedImage(frame));
  if (frame.isTurned) turnUpsideDown(*boxes);
  return boxes;
}

}  // namespace quadmap
