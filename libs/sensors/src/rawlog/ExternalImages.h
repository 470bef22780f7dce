#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <map>
#include <string>

namespace quadmap
{
/** A folder of external images that appears complete or not at all. */
class ExternalImages
{
 public:
  /** \exception std::runtime_error If the folder exists already or cannot be made. */
  explicit ExternalImages(std::string folder);
  ~ExternalImages();  //!< Removes everything unless commit() was called
  ExternalImages(const ExternalImages&) = delete;
  ExternalImages& operator=(const ExternalImages&) = delete;

  /** Writes the images of a scan into the folder. The scan keeps the names of the files.
   *  \exception std::runtime_error For a full disk and the like. */
  void moveOut(mrpt::obs::CObservation3DRangeScan& scan, int jpegQuality);

  void commit();

 private:
  std::string folder_, temporary_;
  std::map<std::string, std::size_t> scans_;  // number of scans so far, by sensor
  bool committed_ = false;
};

}  // namespace quadmap
