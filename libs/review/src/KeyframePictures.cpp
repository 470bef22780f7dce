#include "quadmap/review/KeyframePictures.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "BoxObjects.h"
#include "SimpleMapReader.h"
#include "quadmap/review/FramePicture.h"
#include "quadmap/review/SceneRenderer.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;
using mrpt::obs::CObservation3DRangeScan;

/** The boxes of a scan among the observations of its keyframe; null when there are none. */
CObservationObjects::Ptr boxesOf(
    const CObservation3DRangeScan& scan, const mrpt::obs::CSensoryFrame& observations)
{
  for (const auto& observation : observations)
    if (auto boxes = std::dynamic_pointer_cast<CObservationObjects>(observation);
        boxes && boxes->sensorLabel == scan.sensorLabel && boxes->timestamp == scan.timestamp)
      return boxes;
  return nullptr;
}

class KeyframePictures
{
 public:
  KeyframePictures(
      const std::string& result,
      const std::vector<ObjectRecord>& objects,
      const std::string& folder) :
      scansPath_(result + "/map.simplemap"),
      scans_(scansPath_),
      boxes_(openBoxes(result)),
      objectsOfBoxes_(result + "/report.json"),
      objects_(objects),
      folder_(folder)
  {
    if (scans_.size() != boxes_.size())
      throw std::runtime_error(
          result + ": map.simplemap and objects.simplemap are of different runs");
    fs::create_directories(folder);
  }

  std::size_t write(const std::function<void(double)>& progress)
  {
    for (std::size_t i = 0; const auto keyframe = scans_.next(); ++i)
    {
      const auto boxes = boxes_.next();
      for (const auto& observation : *keyframe->observations)
        if (const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation))
          writePictureOf(
              *scan, boxesOf(*scan, *boxes->observations).get(), keyframe->pose->getMeanVal());
      progress(static_cast<double>(i + 1) / static_cast<double>(scans_.size()));
    }
    return written_;
  }

 private:
  static SimpleMapReader openBoxes(const std::string& result)
  {
    registerObsClasses();
    return SimpleMapReader(result + "/objects.simplemap");
  }

  void writePictureOf(
      const CObservation3DRangeScan& scan,
      const CObservationObjects* boxes,
      const mrpt::poses::CPose3D& T_map_robot)
  {
    // A file beside the map could be any file of the user's.
    if (scan.rangeImage_isExternallyStored() || scan.intensityImage.isExternallyStored())
      throw std::runtime_error(scansPath_ + ": the images of a keyframe are not in it");
    FramePictureContent content;
    content.scan = &scan;
    content.boxes = boxes;
    const double time = mrpt::Clock::toDouble(scan.timestamp);
    for (const auto& id : objectsOfBoxes_.of(scan.sensorLabel, time))
      content.objectOfBox.push_back(id ? std::to_string(*id) : "");
    const mrpt::poses::CPose3D T_sensor_map = -(T_map_robot + scan.sensorPose);
    const auto& ids = content.objectOfBox;
    for (const auto& object : objects_)
      if (std::find(ids.begin(), ids.end(), object.id) != ids.end())
        content.objects.push_back(
            {object.id, object.label, object.object.transformed(T_sensor_map)});
    const std::string name = mrpt::format("frame-%06zu.jpg", written_++);
    writePicture(drawFrame(content), (fs::path(folder_) / name).string());
  }

  std::string scansPath_;
  SimpleMapReader scans_, boxes_;
  BoxObjects objectsOfBoxes_;
  const std::vector<ObjectRecord>& objects_;
  std::string folder_;
  std::size_t written_ = 0;
};

}  // namespace

std::size_t writeKeyframePictures(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const std::string& folder,
    const std::function<void(double)>& progress)
{
  return KeyframePictures(result, objects, folder).write(progress);
}

}  // namespace quadmap
