#include "quadmap/review/PageKeyframes.h"

#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "SimpleMapReader.h"
#include "quadmap/base/Json.h"
#include "quadmap/obs/CObservationObjects.h"

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

using ObjectsOfBoxes = std::vector<std::optional<unsigned>>;

/** Which object each box was taken for, from report.json. */
std::map<ImageKey, ObjectsOfBoxes> readDecisions(const std::string& path)
{
  std::map<ImageKey, ObjectsOfBoxes> decisions;
  if (!std::filesystem::exists(path)) return decisions;
  try
  {
    const Json report = readJson(path);
    for (const Json& line : report.at("associations"))
    {
      ObjectsOfBoxes objects;
      for (const Json& box : line.at("boxes"))
      {
        const Json& object = box.at("object");
        objects.push_back(
            object.is_null() ? std::nullopt : std::optional<unsigned>(object.get<unsigned>()));
      }
      const double time = line.at("time").get<double>();
      decisions[keyOf(line.at("sensor").get<std::string>(), time)] = std::move(objects);
    }
  }
  catch (const nlohmann::json::exception&)
  {
    throw std::runtime_error(path + ": its \"associations\" are not those of quadmap-slam");
  }
  return decisions;
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
  constexpr std::array kQualities = {80, 65, 50, 35, 20};
  const cv::Mat& full = image.asCvMatRef();
  const double scale = std::min(1.0, double(options_.longerSide) / std::max(full.cols, full.rows));
  cv::Mat reduced;
  cv::resize(full, reduced, {}, scale, scale, cv::INTER_AREA);
  std::vector<std::uint8_t> jpeg;
  for (const int quality : kQualities)
  {
    cv::imencode(".jpg", reduced, jpeg, {cv::IMWRITE_JPEG_QUALITY, quality});
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
  const std::map<ImageKey, ObjectsOfBoxes> decisions = readDecisions(reportPath);
  std::map<ImageKey, PageKeyframe*> keyframeOf;
  for (PageKeyframe& keyframe : keyframes)
    keyframeOf[keyOf(keyframe.sensor, keyframe.time)] = &keyframe;

  SimpleMapReader reader(objectsPath);
  while (const auto node = reader.next())
    for (const auto& observation : *node->observations)
    {
      const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(observation);
      if (!boxes) continue;
      const ImageKey key = keyOf(boxes->sensorLabel, mrpt::Clock::toDouble(boxes->timestamp));
      const auto keyframe = keyframeOf.find(key);
      if (keyframe == keyframeOf.end()) continue;
      std::vector<PageBox>& out = keyframe->second->boxes;
      for (const DetectedObject& object : boxes->objects) out.push_back(pageBoxOf(object));
      const auto decided = decisions.find(key);
      if (decided == decisions.end() || decided->second.size() != out.size()) continue;
      for (std::size_t i = 0; i < out.size(); ++i) out[i].object = decided->second[i];
    }
}

}  // namespace quadmap
