#include "quadmap/review/KeyframePictures.h"

#include <set>

#include "quadmap/review/FramePicture.h"
#include "quadmap/review/FramePictureFolder.h"
#include "quadmap/sensors/ResultKeyframes.h"

namespace quadmap
{
namespace
{
class KeyframePictures
{
 public:
  KeyframePictures(
      const std::string& result,
      const std::vector<ObjectRecord>& objects,
      const std::string& folder,
      OutputGroup& group) :
      keyframes_(result, ResultKeyframes::Boxes::Read), objects_(objects), pictures_(folder, &group)
  {
    for (const auto& object : objects) ids_.insert(object.id);
  }

  std::size_t write(const std::function<void(double)>& progress)
  {
    while (const auto images = keyframes_.next())
    {
      for (const KeyframeScan& image : *images) writePictureOf(image);
      progress(
          static_cast<double>(keyframes_.keyframesRead()) / static_cast<double>(keyframes_.size()));
    }
    pictures_.commit();
    return written_;
  }

 private:
  void writePictureOf(const KeyframeScan& image)
  {
    FramePictureContent content;
    content.scan = image.scan.get();
    content.boxes = image.boxes.get();
    std::set<std::string> shown;
    for (const auto& number : image.objectOfBox)
    {
      const std::string id = number ? std::to_string(*number) : "";
      // The back end may have dropped it since, or never confirmed it.
      const bool isNone = number && ids_.count(id) == 0;
      content.objectOfBox.push_back(isNone ? id + " (not in the map)" : id);
      shown.insert(id);
    }
    const mrpt::poses::CPose3D T_sensor_map = -(image.T_map_robot + image.scan->sensorPose);
    for (const auto& object : objects_)
      if (shown.count(object.id) > 0)
        content.objects.push_back(
            {object.id, object.label, object.object.transformed(T_sensor_map)});
    pictures_.add(written_++, drawFrame(content));
  }

  ResultKeyframes keyframes_;
  const std::vector<ObjectRecord>& objects_;
  std::set<std::string> ids_;  // of the objects
  FramePictureFolder pictures_;
  std::size_t written_ = 0;
};

}  // namespace

std::size_t writeKeyframePictures(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const std::string& folder,
    OutputGroup& group,
    const std::function<void(double)>& progress)
{
  return KeyframePictures(result, objects, folder, group).write(progress);
}

}  // namespace quadmap
