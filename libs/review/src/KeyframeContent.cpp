#include "quadmap/review/KeyframeContent.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "quadmap/sensors/SimpleMapReader.h"

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

CameraPose cameraOf(const CObservation3DRangeScan& scan, const mrpt::poses::CPose3D& T_map_robot)
{
  const mrpt::img::TCamera& c = scan.cameraParams;
  CameraPose camera;
  camera.T_map_sensor = T_map_robot + scan.sensorPose;
  if (c.ncols > 0 && c.nrows > 0 && c.fx() > 0 && c.fy() != 0)
  {
    camera.horizontalFov = 2 * std::atan(0.5 * c.ncols / c.fx());
    camera.verticalFov = 2 * std::atan(0.5 * c.nrows / std::abs(c.fy()));
  }
  return camera;
}

/** Chooses the share of pixels that is worth the time. */
CloudCollector::Selection selectionOf(
    const CObservation3DRangeScan& scan, const CloudOptions& options, std::size_t keyframes)
{
  constexpr std::size_t kMany = 30;  // with so many frames each place is in several
  const double usefulPixels = keyframes < kMany ? 80e3 : 40e3;
  const auto pixels = static_cast<double>(scan.rangeImage.rows() * scan.rangeImage.cols());
  CloudCollector::Selection selection;
  selection.maxRange = options.maxRange;
  selection.stride = std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / usefulPixels))));
  return selection;
}

}  // namespace

void addKeyframes(
    const std::string& simpleMapPath,
    const CloudOptions& options,
    SceneContent& content,
    const KeyframeVisitor& visit)
{
  SimpleMapReader reader(simpleMapPath);
  CloudCollector collector(options.cellSize, options.maxPoints);
  const std::size_t step = (reader.size() + options.maxKeyframes - 1) / options.maxKeyframes;
  std::map<std::string, std::size_t> imagesOfSensor;  // number of images by sensor
  for (std::size_t i = 0; const auto keyframe = reader.next(); ++i)
  {
    const mrpt::poses::CPose3D T_map_robot = keyframe->pose->getMeanVal();
    for (const auto& observation : *keyframe->observations)
    {
      const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
      if (!scan) continue;
      content.cameras.push_back(cameraOf(*scan, T_map_robot));
      const bool isUsed = imagesOfSensor[scan->sensorLabel]++ % step == 0;
      if (!isUsed && !visit) continue;
      try
      {
        // A file beside the map could be any file of the user's.
        if (scan->rangeImage_isExternallyStored() || scan->intensityImage.isExternallyStored())
          throw std::runtime_error("its images are not in the simple map");
        if (visit) visit(*scan, content.cameras.back(), reader.size());
        if (isUsed && scan->hasRangeImage)
          collector.add(*scan, T_map_robot, selectionOf(*scan, options, reader.size()));
      }
      catch (const std::exception&)  // its text is about the inside of the library
      {
        throw std::runtime_error(mrpt::format(
            "%s: keyframe %zu, sensor '%s': the depth image cannot be used", simpleMapPath.c_str(),
            i + 1, scan->sensorLabel.c_str()));
      }
    }
  }
  collector.closeGaps(options.maxCellSize);
  content.cloud = collector.points();
  content.cloudCellSize = collector.cellSize();
}

}  // namespace quadmap
