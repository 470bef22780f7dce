#include "quadmap/sensors/SimpleMapReader.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/poses/registerAllClasses.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/ArchiveFields.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/sensors/BoxCheck.h"
#include "records/UnreadableRecord.h"

namespace quadmap
{
namespace
{
const std::string& existing(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error(path + ": cannot be read");
  return path;
}

/** Reads the head of a serialised object: length of the name with bit 7 set, name, version. */
bool readSimpleMapHead(mrpt::serialization::CArchive& archive)
{
  const std::string expected = "mrpt::maps::CSimpleMap";
  const auto length = readScalar<std::uint8_t>(archive);
  if ((length & 0x80) == 0 || (length & 0x7F) > 64) return false;
  std::string name(length & 0x7F, ' ');
  readBytes(archive, name.data(), name.size());
  constexpr std::uint8_t kVersion = 1;  // since MRPT 0.9: a count, then pairs of pose and frame
  return name == expected && readScalar<std::uint8_t>(archive) == kVersion;
}

/** Why a box is absurd. What merely shows nothing, a box without area or beside the image, is in
 * maps of other programs, and is measured as such. */
std::optional<std::string> whyNoBoxes(const CObservationObjects& boxes)
{
  const auto& camera = boxes.cameraParams;
  for (std::size_t i = 0; i < boxes.objects.size(); ++i)
  {
    const ImageBox& box = boxes.objects[i].box;
    const bool isFinite = std::isfinite(box.x1 + box.y1 + box.x2 + box.y2);
    if (!isFinite || (camera.ncols > 0 && isFarOutside(box, camera.ncols, camera.nrows)))
      return mrpt::format(
          "box %zu of %zu (%s) of %s lies far outside the image", i + 1, boxes.objects.size(),
          boxes.objects[i].label.c_str(), boxes.sensorLabel.c_str());
  }
  return std::nullopt;
}

/** Why the pose of a keyframe, or of a camera in it, or a box, cannot be one. */
std::optional<std::string> whyNoKeyframe(const SimpleMapReader::Keyframe& keyframe)
{
  if (const auto why = whyNoPose(keyframe.pose->getMeanVal())) return "its pose " + *why;
  for (const auto& observation : *keyframe.observations)
  {
    if (const auto scan =
            std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation))
      if (const auto why = whyNoPose(scan->sensorPose, kFarthestOnRobot))
        return "the sensorPose of " + scan->sensorLabel + " " + *why;
    if (const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(observation))
      if (const auto why = whyNoBoxes(*boxes)) return why;
  }
  return std::nullopt;
}

}  // namespace

SimpleMapReader::SimpleMapReader(const std::string& path) :
    path_(path), file_(existing(path)), records_(file_)
{
  mrpt::poses::registerAllClasses_mrpt_poses();
  mrpt::obs::registerAllClasses_mrpt_obs();
  try
  {
    auto archive = mrpt::serialization::archiveFrom(file_);
    if (readSimpleMapHead(archive))
    {
      size_ = readScalar<std::uint32_t>(archive);
      return;
    }
  }
  catch (const std::exception&)  // the file is shorter than the head
  {
  }
  throw std::runtime_error(path + ": is not a simple map (.simplemap) that can be read");
}

std::optional<SimpleMapReader::Keyframe> SimpleMapReader::next()
{
  if (read_ == size_)
  {
    requireEnd();
    return std::nullopt;
  }
  ++read_;
  const std::string place = mrpt::format("%s: keyframe %zu of %zu", path_.c_str(), read_, size_);
  Keyframe keyframe;
  keyframe.pose = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDF>(object(place));
  keyframe.observations = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object(place));
  if (!keyframe.pose || !keyframe.observations)
    throw std::runtime_error(
        place + " is no pose with observations: the file is truncated or damaged");
  if (const auto why = whyNoKeyframe(keyframe)) throw std::runtime_error(place + ": " + *why);
  return keyframe;
}

mrpt::serialization::CSerializable::Ptr SimpleMapReader::object(const std::string& place)
{
  file_.startRecord();
  try
  {
    return records_.next();
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(place + ": " + whyUnreadable(file_.recordHead(), file_.failure(), e));
  }
}

void SimpleMapReader::requireEnd()
{
  try
  {
    constexpr std::uint64_t kEndMark = 1;  // of MRPT behind each object [bytes]
    if (file_.skipToEnd() > kEndMark)      // the checksum comes last
      throw std::runtime_error("more follows the last keyframe");
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path_ + ": " + e.what());
  }
}

}  // namespace quadmap
