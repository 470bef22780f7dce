#include "rawlog/ExternalImages.h"

#include <mrpt/core/format.h>
#include <mrpt/system/filesystem.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputSet.h"
#include "rawlog/RecordReader.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

// MRPT does not notice that the end of a file was not written.
void requireCompleteGz(const std::string& path) { GzInput(path, false).skipToEnd(); }

void requireCompleteJpeg(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(-2, std::ios::end);
  if (file.get() != 0xFF || file.get() != 0xD9) throw std::runtime_error("incomplete JPEG");
}
}  // namespace

void ExternalImages::moveOut(mrpt::obs::CObservation3DRangeScan& scan, int jpegQuality)
{
  moveOut(
      scan,
      [&](const std::string& path)
      {
        if (!scan.intensityImage.saveToFile(path, jpegQuality))
          throw std::runtime_error("cannot be written");
        requireCompleteJpeg(path);
      });
}

void ExternalImages::moveOut(
    mrpt::obs::CObservation3DRangeScan& scan, const std::vector<std::uint8_t>& jpeg)
{
  moveOut(
      scan,
      [&](const std::string& path)
      {
        std::ofstream file(path, std::ios::binary);
        file.write(
            reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
        if (!file.flush()) throw std::runtime_error("cannot be written");
      });
}

void ExternalImages::moveOut(
    mrpt::obs::CObservation3DRangeScan& scan,
    const std::function<void(const std::string&)>& writeColor)
{
  const std::string name = mrpt::format(
      "%s_%06zu", mrpt::system::fileNameStripInvalidChars(scan.sensorLabel).c_str(),
      scans_[scan.sensorLabel]++);
  std::string now = name;
  try
  {
    if (scan.hasRangeImage)
    {
      now = name + "_depth.bin";
      scan.rangeImage_convertToExternalStorage(now, folder_ + "/");
      requireCompleteGz(folder_ + "/" + now);
    }
    if (scan.hasIntensityImage)
    {
      now = name + ".jpg";
      writeColor(folder_ + "/" + now);
      scan.intensityImage.setExternalStorage(now);
    }
  }
  catch (const std::exception& e)
  {
    const int error = errorOfWritingTo(folder_ + "/" + now);
    throw std::runtime_error(
        pathAfterCommit(folder_) + "/" + now + ": " +
        (error != 0 ? std::string("cannot be written: ") + std::strerror(error) : rootMessage(e)));
  }
}

}  // namespace quadmap
