#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quadmap
{
/** A folder of external images. */
class ExternalImages
{
 public:
  /** \param folder It exists. */
  explicit ExternalImages(std::string folder) : folder_(std::move(folder)) {}

  /** Writes the images of a scan into the folder. The scan keeps the names of the files.
   *  \exception std::runtime_error For a full disk and the like. */
  void moveOut(mrpt::obs::CObservation3DRangeScan& scan, int jpegQuality);

  /** The same for a scan whose colour image is this JPEG file, as it is. */
  void moveOut(mrpt::obs::CObservation3DRangeScan& scan, const std::vector<std::uint8_t>& jpeg);

 private:
  /** \param writeColor Writes the colour image to a path. */
  void moveOut(
      mrpt::obs::CObservation3DRangeScan& scan,
      const std::function<void(const std::string&)>& writeColor);

  std::string folder_;
  std::map<std::string, std::size_t> scans_;  // number of scans so far, by sensor
};

}  // namespace quadmap
