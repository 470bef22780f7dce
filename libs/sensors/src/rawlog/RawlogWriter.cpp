#include "quadmap/sensors/RawlogWriter.h"

#include <mrpt/core/format.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <stdexcept>

#include "quadmap/base/GzipStream.h"
#include "quadmap/base/OutputGroup.h"
#include "rawlog/ExternalImages.h"
#include "rawlog/ScanWithJpeg.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Sets how MRPT stores colour images, which is a global setting, while this object lives. */
class JpegSetting
{
 public:
  explicit JpegSetting(int quality) :
      disabled_(mrpt::img::CImage::DISABLE_JPEG_COMPRESSION()),
      quality_(mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY())
  {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
    mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY(quality);
  }
  ~JpegSetting()
  {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(disabled_);
    mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY(quality_);
  }
  JpegSetting(const JpegSetting&) = delete;
  JpegSetting& operator=(const JpegSetting&) = delete;

 private:
  bool disabled_;
  int quality_;
};

void writeTo(GzipFileWriter& file, const mrpt::serialization::CSerializable& object)
{
  mrpt::serialization::archiveFrom(file) << object;
  file.requireWritten();
}

RawlogWriterOptions checked(RawlogWriterOptions options)
{
  if (options.compressionLevel < 0 || options.compressionLevel > 9)
    throw std::invalid_argument(
        mrpt::format("compressionLevel=%d: must be 0..9", options.compressionLevel));
  if (options.jpegQuality < 1 || options.jpegQuality > 100)
    throw std::invalid_argument(
        mrpt::format("jpegQuality=%d: must be 1..100", options.jpegQuality));
  return options;
}
}  // namespace

struct RawlogWriter::Impl
{
  Impl(const std::string& f, RawlogWriterOptions o) :
      file(f),
      options(checked(o)),
      files(outputs.addToFolder(fs::path(f).parent_path().string(), nameOf(f))),
      rawlog(files.add(nameOf(f)), options.compressionLevel)
  {
    if (options.external)
      images = std::make_unique<ExternalImages>(files.addFolder(nameOf(imagesFolderOf(f))));
  }

  /** The name of a file without its folder. */
  static std::string nameOf(const std::string& path) { return fs::path(path).filename().string(); }

  std::string file;
  RawlogWriterOptions options;
  OutputGroup outputs;
  OutputSet& files;  // those beside the rawlog, which are one of the outputs
  GzipFileWriter rawlog;
  std::unique_ptr<GzipFileWriter> sidecar;  // created with the first boxes
  std::unique_ptr<ExternalImages> images;   // null when images are in the rawlog
};

RawlogWriter::RawlogWriter(const std::string& file, RawlogWriterOptions options) :
    impl_(std::make_unique<Impl>(file, options))
{
}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(mrpt::obs::CObservation3DRangeScan& scan)
{
  if (impl_->images) impl_->images->moveOut(scan, impl_->options.jpegQuality);
  const JpegSetting setting(impl_->options.jpegQuality);
  writeTo(impl_->rawlog, scan);
}

void RawlogWriter::write(
    mrpt::obs::CObservation3DRangeScan& scan, const std::vector<std::uint8_t>& jpeg)
{
  if (impl_->images)
  {
    impl_->images->moveOut(scan, jpeg);
    return writeTo(impl_->rawlog, scan);
  }
  writeWithJpeg(scan, jpeg, impl_->rawlog);
  impl_->rawlog.requireWritten();
}

void RawlogWriter::write(const CObservationObjects& boxes)
{
  if (!impl_->sidecar)
    impl_->sidecar = std::make_unique<GzipFileWriter>(
        add(Impl::nameOf(objectsFileOf(impl_->file))), impl_->options.compressionLevel);
  writeTo(*impl_->sidecar, boxes);
}

void RawlogWriter::writePose(
    mrpt::Clock::time_point time,
    const std::string& label,
    const mrpt::poses::CPose3D& T_parent_robot)
{
  mrpt::obs::CObservationRobotPose pose;
  pose.timestamp = time;
  pose.sensorLabel = label;
  pose.pose.mean = T_parent_robot;
  writeTo(impl_->rawlog, pose);
}

std::string RawlogWriter::add(const std::string& name) { return impl_->files.add(name); }

std::string RawlogWriter::addElsewhere(const std::string& path) { return impl_->outputs.add(path); }

void RawlogWriter::finish()
{
  impl_->rawlog.commit();
  if (impl_->sidecar)
    impl_->sidecar->commit();
  else
    impl_->files.addRemoval(Impl::nameOf(objectsFileOf(impl_->file)));
  impl_->outputs.commit();
}

}  // namespace quadmap
