#include "keyframes/KeyframeSpool.h"

#include <fcntl.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "quadmap/base/GzipStream.h"
#include "quadmap/base/Temporary.h"

namespace quadmap
{
using mrpt::img::CImage;
using mrpt::obs::CObservation3DRangeScan;

namespace
{
constexpr int kFastCompression = 1;  //!< Compression level; higher ones are slow and gain little
constexpr int kBestCompression = 9;
/** A larger scan is compressed in several members, so that its bytes need not be in memory. */
constexpr std::size_t kPieceBytes = 16u << 20;

/** Stores colour images as JPEG while it lives. MRPT's default, raw pixels, is three times as
 * large.
 */
class JpegSerialization
{
 public:
  JpegSerialization() : before_(CImage::DISABLE_JPEG_COMPRESSION())
  {
    CImage::DISABLE_JPEG_COMPRESSION(false);
  }
  ~JpegSerialization() { CImage::DISABLE_JPEG_COMPRESSION(before_); }
  JpegSerialization(const JpegSerialization&) = delete;
  JpegSerialization& operator=(const JpegSerialization&) = delete;

 private:
  bool before_;
};

/** A copy of the image that does not depend on an external file. */
CImage embedded(const CImage& image)
{
  image.forceLoad();
  CImage copy;
  copy.resize(image.getWidth(), image.getHeight(), image.getChannelCount(), image.getPixelDepth());
  const std::size_t rowBytes = image.getWidth() *
                               static_cast<std::size_t>(image.getChannelCount()) *
                               (image.getPixelDepth() == mrpt::img::PixelDepth::D8U ? 1 : 2);
  for (unsigned row = 0; row < image.getHeight(); ++row)
    std::memcpy(copy.ptrLine<std::uint8_t>(row), image.ptrLine<std::uint8_t>(row), rowBytes);
  return copy;
}

/** A copy of the scan with what a reader needs: calibration, depth and colour. */
CObservation3DRangeScan::Ptr storedForm(const CObservation3DRangeScan& scan)
{
  auto stored = CObservation3DRangeScan::Create(scan);
  stored->rangeImage_forceResetExternalStorage();
  stored->points3D_overrideExternalStoredFlag(false);
  stored->hasPoints3D = false;
  stored->resizePoints3DVectors(0);
  if (stored->hasIntensityImage && scan.intensityImage.isExternallyStored())
    stored->intensityImage = embedded(scan.intensityImage);
  return stored;
}

}  // namespace

KeyframeSpool::KeyframeSpool(const std::string& directory) : directory_(directory)
{
  std::string path = directory + "/.keyframes.XXXXXX";
  const auto pause = Temporary::pause();  // no signal ends the program between the next lines
  descriptor_ = ::mkostemp(path.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot be written", errno);
  ::unlink(path.c_str());
}

void KeyframeSpool::fail(const char* what, int error) const
{
  throw std::runtime_error(
      directory_ + ": the temporary file of keyframes " + what + ": " + std::strerror(error));
}

KeyframeSpool::~KeyframeSpool()
{
  if (descriptor_ >= 0) ::close(descriptor_);
}

void KeyframeSpool::append(const CObservation3DRangeScan& scan, const CObservationObjects* objects)
{
  const JpegSerialization jpeg;
  KeyframeBlocks blocks;
  blocks.scan = writeInPieces(*storedForm(scan));
  if (objects) blocks.objects = write(gzipMember(archiveBytes(*objects), kBestCompression));
  keyframes_.push_back(blocks);
}

KeyframeSpool::Bytes KeyframeSpool::scanMembers(std::size_t keyframe) const
{
  return read(keyframes_.at(keyframe).scan);
}

std::optional<KeyframeSpool::Bytes> KeyframeSpool::objectsMember(std::size_t keyframe) const
{
  const auto& block = keyframes_.at(keyframe).objects;
  if (!block) return std::nullopt;
  return read(*block);
}

CObservationObjects::Ptr KeyframeSpool::objects(std::size_t keyframe) const
{
  const auto member = objectsMember(keyframe);
  if (!member) return nullptr;
  const Bytes bytes = gunzipMember(*member);
  mrpt::io::CMemoryStream memory;
  memory.assignMemoryNotOwn(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(memory).ReadObject<CObservationObjects>();
}

KeyframeSpool::Block KeyframeSpool::writeInPieces(const CObservation3DRangeScan& scan)
{
  Block block{end_, 0};
  std::exception_ptr failure;  // archives would wrap it in a call stack
  const auto add = [&](const Bytes& member)
  {
    try
    {
      if (!failure) block.size += write(member).size;
    }
    catch (...)
    {
      failure = std::current_exception();
    }
  };
  GzipPieces pieces(add, kFastCompression, kPieceBytes);
  auto archive = mrpt::serialization::archiveFrom(pieces);
  archive << scan;
  pieces.flush();
  if (failure) std::rethrow_exception(failure);
  return block;
}

KeyframeSpool::Block KeyframeSpool::write(const Bytes& bytes)
{
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const auto n = ::pwrite(
        descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(end_ + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot be written", n < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(n);
  }
  const Block block{end_, bytes.size()};
  end_ += bytes.size();
  return block;
}

KeyframeSpool::Bytes KeyframeSpool::read(const Block& block) const
{
  Bytes bytes(block.size);
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const auto n = ::pread(
        descriptor_, bytes.data() + done, bytes.size() - done,
        static_cast<off_t>(block.offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot be read", n < 0 ? errno : EIO);
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace quadmap
