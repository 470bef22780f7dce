#include "quadmap/review/PageKeyframes.h"

#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "quadmap/obs/BoxObjects.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/SimpleMapReader.h"

namespace quadmap
{
namespace
{
/** A sensor and a time in microseconds tell one image of a run. */
using ImageKey = std::pair<std::string, std::int64_t>;

ImageKey keyOf(const std::string& sensor, double time)
{
  return {sensor, std::llround(time * 1e6)};
}

PageBox pageBoxOf(const DetectedObject& object)
{
  PageBox box;
  box.label = object.label;
  box.kind = nameOf(object.measurement.kind);
  box.reason = object.measurement.reason;
  box.score = object.score;
  box.box = object.box;
  return box;
}

}  // namespace

PageImages::PageImages(const PageImageOptions& options, std::size_t count) :
    options_(options), bytesPerImage_(options.totalBytes / std::max<std::size_t>(count, 1))
{
}

void PageImages::add(const mrpt::obs::CObservation3DRangeScan& scan, const CameraPose& camera)
{
  PageKeyframe keyframe;
  keyframe.time = mrpt::Clock::toDouble(scan.timestamp);
  keyframe.sensor = scan.sensorLabel;
  keyframe.camera = camera;
  keyframe.width = scan.cameraParamsIntensity.ncols;
  keyframe.height = scan.cameraParamsIntensity.nrows;
  if (scan.hasIntensityImage && !scan.intensityImage.isEmpty())
  {
    keyframe.width = static_cast<unsigned>(scan.intensityImage.getWidth());
    keyframe.height = static_cast<unsigned>(scan.intensityImage.getHeight());
    keyframe.jpeg = jpegOf(scan.intensityImage);
  }
  keyframes_.push_back(std::move(keyframe));
}

std::string PageImages::jpegOf(const mrpt::img::CImage& image) const
{
  // From the best to one that is still worth looking at.
  struct Grade
  {
    double size;
    int quality;
  };
  constexpr std::array kGrades = {
      Grade{1.0, 80},
      Grade{1.0, 65},
      Grade{0.5, 80},
      Grade{0.5, 65},
      Grade{0.5, 50},
      Grade{0.5, 35},
      Grade{0.5, 20}
  };
  const cv::Mat& full = image.asCvMatRef();
  const int longerSide = std::max(full.cols, full.rows);
  std::vector<std::uint8_t> jpeg;
  for (const Grade& grade : kGrades)
  {
    const double scale = std::min(1.0, grade.size * options_.longerSide / longerSide);
    cv::Mat reduced;
    cv::resize(full, reduced, {}, scale, scale, cv::INTER_AREA);
    cv::imencode(".jpg", reduced, jpeg, {cv::IMWRITE_JPEG_QUALITY, grade.quality});
    if (jpeg.size() <= bytesPerImage_) break;
  }
  return {jpeg.begin(), jpeg.end()};
}

void addPageBoxes(
    const std::string& objectsPath,
    const std::string& reportPath,
    std::vector<PageKeyframe>& keyframes)
{
  registerObsClasses();
  const BoxObjects decisions(reportPath);
  std::map<ImageKey, PageKeyframe*> keyframeOf;
  for (PageKeyframe& keyframe : keyframes)
    keyframeOf[keyOf(keyframe.sensor, keyframe.time)] = &keyframe;

  SimpleMapReader reader(objectsPath);
  while (const auto node = reader.next())
    for (const auto& observation : *node->observations)
    {
      const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(observation);
      if (!boxes) continue;
      const double time = mrpt::Clock::toDouble(boxes->timestamp);
      const auto keyframe = keyframeOf.find(keyOf(boxes->sensorLabel, time));
      if (keyframe == keyframeOf.end()) continue;
      std::vector<PageBox>& out = keyframe->second->boxes;
      for (const DetectedObject& object : boxes->objects) out.push_back(pageBoxOf(object));
      const auto objects = decisions.of(boxes->sensorLabel, time);
      if (objects.size() != out.size()) continue;
      for (std::size_t i = 0; i < out.size(); ++i) out[i].object = objects[i];
    }
}

}  // namespace quadmap
