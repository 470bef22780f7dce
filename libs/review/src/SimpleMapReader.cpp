#include "SimpleMapReader.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/poses/registerAllClasses.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** Reads the head of a serialised object: length of the name with bit 7 set, name, version. */
bool readSimpleMapHead(mrpt::serialization::CArchive& archive)
{
  const std::string expected = "mrpt::maps::CSimpleMap";
  const auto length = archive.ReadAs<std::uint8_t>();
  if ((length & 0x80) == 0 || (length & 0x7F) > 64) return false;
  std::string name(length & 0x7F, ' ');
  archive.ReadBuffer(name.data(), name.size());
  constexpr std::uint8_t kVersion = 1;  // since MRPT 0.9: a count, then pairs of pose and frame
  return name == expected && archive.ReadAs<std::uint8_t>() == kVersion;
}

const std::string& existing(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error(path + ": cannot be read");
  return path;
}

}  // namespace

SimpleMapReader::SimpleMapReader(const std::string& path) : path_(path), file_(existing(path))
{
  mrpt::poses::registerAllClasses_mrpt_poses();
  mrpt::obs::registerAllClasses_mrpt_obs();
  try
  {
    auto archive = mrpt::serialization::archiveFrom(file_);
    if (readSimpleMapHead(archive))
    {
      size_ = archive.ReadAs<std::uint32_t>();
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
    auto archive = mrpt::serialization::archiveFrom(file_);
    Keyframe keyframe;
    archive >> keyframe.pose >> keyframe.observations;
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
    file_.skipToEnd();  // the checksum comes last
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path_ + ": " + e.what());
  }
}

}  // namespace quadmap
