#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <string>
#include <vector>

#include "quadmap/review/PageContent.h"

namespace quadmap
{
/** How large the images of a page are. */
struct PageImageOptions
{
  unsigned longerSide = 640;            //!< Images are reduced to this, or to half of it [px], > 0
  std::size_t totalBytes = 14'000'000;  //!< Of all JPEGs: with more images each is coarser, > 0
};

/** Makes the page's images one by one, while the recording is read. */
class PageImages
{
 public:
  /** \param count Number of keyframes that will come, or a little less. */
  PageImages(const PageImageOptions& options, std::size_t count);

  /** \param scan Its colour image is loaded; without one the keyframe has no image.
   *  \param camera Where it was taken. */
  void add(const mrpt::obs::CObservation3DRangeScan& scan, const CameraPose& camera);

  std::vector<PageKeyframe>& keyframes() { return keyframes_; }

 private:
  std::string jpegOf(const mrpt::img::CImage& image) const;

  PageImageOptions options_;
  std::size_t bytesPerImage_;
  std::vector<PageKeyframe> keyframes_;
};

/** Gives the keyframes their boxes.
 * \param objectsPath objects.simplemap: boxes and measurements.
 * \param reportPath report.json: which object each box was taken for. It may be missing.
 * \exception std::runtime_error For a file that cannot be read. The message names it. */
void addPageBoxes(
    const std::string& objectsPath,
    const std::string& reportPath,
    std::vector<PageKeyframe>& keyframes);

}  // namespace quadmap
