#include "rawlog/ScanWithJpeg.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace quadmap
{
namespace
{
/** The name of an external image that stands where the JPEG goes. */
const std::string kPlaceholder = "quadmap: the place of a colour image";

void append(std::vector<std::uint8_t>& to, std::uint32_t number)
{
  for (int byte = 0; byte < 4; ++byte)
    to.push_back(static_cast<std::uint8_t>(number >> (8 * byte)));
}

/** What MRPT writes of an external image: that it is one, and its name. */
std::vector<std::uint8_t> externalImage()
{
  std::vector<std::uint8_t> bytes{1};
  append(bytes, static_cast<std::uint32_t>(kPlaceholder.size()));
  bytes.insert(bytes.end(), kPlaceholder.begin(), kPlaceholder.end());
  return bytes;
}

/** What MRPT writes of a colour image that it compresses. */
std::vector<std::uint8_t> embeddedImage(
    const mrpt::img::TCamera& camera, const std::vector<std::uint8_t>& jpeg)
{
  std::vector<std::uint8_t> bytes{0, 1};  // not external, in colour
  bytes.reserve(bytes.size() + 3 * sizeof(std::uint32_t) + jpeg.size());
  append(bytes, camera.ncols);
  append(bytes, camera.nrows);
  append(bytes, static_cast<std::uint32_t>(jpeg.size()));
  bytes.insert(bytes.end(), jpeg.begin(), jpeg.end());
  return bytes;
}
}  // namespace

void writeWithJpeg(
    mrpt::obs::CObservation3DRangeScan& scan,
    const std::vector<std::uint8_t>& jpeg,
    GzipFileWriter& to)
{
  constexpr int kStored = 0;  // a JPEG gets no smaller
  scan.hasIntensityImage = true;
  scan.intensityImage.setExternalStorage(kPlaceholder);
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << scan;

  const auto* first = static_cast<const std::uint8_t*>(memory.getRawBufferData());
  const auto* last = first + memory.getTotalBytesCount();
  const auto external = externalImage();
  // Depth comes first and is long, so that looking from the end is quicker.
  const auto* place = std::find_end(first, last, external.begin(), external.end());
  if (place == last) throw std::logic_error("MRPT archives images in another form");
  const auto* rest = place + external.size();
  const auto embedded = embeddedImage(scan.cameraParamsIntensity, jpeg);
  to.Write(first, static_cast<std::size_t>(place - first));
  to.appendMember(gzipMember(embedded, kStored));
  to.Write(rest, static_cast<std::size_t>(last - rest));
  scan.intensityImage = mrpt::img::CImage();
}

}  // namespace quadmap
