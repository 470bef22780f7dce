#include "quadmap/sensors/SimpleMapReader.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/poses/registerAllClasses.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <stdexcept>

#include "quadmap/base/ArchiveFields.h"

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
  try
  {
    file_.startRecord();
    Keyframe keyframe;
    keyframe.pose = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDF>(records_.next());
    keyframe.observations = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(records_.next());
    if (keyframe.pose && keyframe.observations) return keyframe;
  }
  catch (const std::exception&)  // its text is about the inside of the archive
  {
  }
  throw std::runtime_error(mrpt::format(
      "%s: keyframe %zu of %zu cannot be read: the file is truncated or damaged", path_.c_str(),
      read_, size_));
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
