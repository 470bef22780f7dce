#include "rawlog/ScanCheck.h"

#include <mrpt/core/format.h>
#include <mrpt/io/lazy_load_path.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "DepthUnit.h"
#include "ImageFile.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/sensors/BoxCheck.h"
#include "rawlog/RecordReader.h"

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

void requireFile(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error("its external image " + path + " is missing");
}

/** Loads an external depth image of MRPT, a gzip file of rows and columns (4 bytes each) and 16
 * bits per pixel. MRPT's own loader crashes on damaged files. */
void loadDepthFile(const std::string& path, CObservation3DRangeScan& scan)
{
  constexpr std::uint32_t kMaxPixels = 20000;  // per side
  GzInput file(path);
  std::uint32_t size[2] = {0, 0};
  if (file.Read(size, sizeof size) == 0) throw std::runtime_error("it is empty");
  const auto [rows, columns] = size;
  if (rows < 1 || rows > kMaxPixels || columns < 1 || columns > kMaxPixels)
    throw std::runtime_error(mrpt::format("a size of %ux%u is not plausible", columns, rows));
  scan.rangeImage_setSize(static_cast<int>(rows), static_cast<int>(columns));
  const std::size_t bytes = std::size_t{rows} * columns * sizeof(std::uint16_t);
  file.Read(scan.rangeImage.data(), bytes);
}

void loadExternalDepth(CObservation3DRangeScan& scan)
{
  const std::string path = scan.rangeImage_getExternalStorageFileAbsolutePath("");
  requireFile(path);
  try
  {
    if (std::filesystem::path(path).extension() == ".txt")
      scan.load();
    else
      loadDepthFile(path, scan);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error("its external image " + path + " cannot be read: " + rootMessage(e));
  }
  scan.rangeImage_forceResetExternalStorage();
}

void loadExternalColor(CObservation3DRangeScan& scan)
{
  const std::string path = scan.intensityImage.getExternalStorageFileAbsolutePath();
  requireFile(path);
  try
  {
    const cv::Mat image = readImageFile(path, cv::IMREAD_COLOR);
    scan.intensityImage = mrpt::img::CImage(image, mrpt::img::SHALLOW_COPY);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error("its external image " + path + " " + e.what());
  }
}

/** Loads the external images into the scan. */
void loadExternalImages(CObservation3DRangeScan& scan, const std::string& folder)
{
  mrpt::io::setLazyLoadPathBase(folder);
  if (scan.rangeImage_isExternallyStored()) loadExternalDepth(scan);
  if (scan.hasIntensityImage && scan.intensityImage.isExternallyStored()) loadExternalColor(scan);
}

void requireCalibration(const CObservation3DRangeScan& scan)
{
  const auto& camera = scan.cameraParams;
  const auto& K = camera.intrinsicParams;
  if (!K.asEigen().allFinite() || K(0, 0) == 0 || K(1, 1) == 0)
    throw std::runtime_error(
        mrpt::format("has no camera calibration (fx=%g, fy=%g in cameraParams)", K(0, 0), K(1, 1)));
  const auto rows = scan.rangeImage.rows(), columns = scan.rangeImage.cols();
  if (static_cast<int>(camera.nrows) != rows || static_cast<int>(camera.ncols) != columns)
    throw std::runtime_error(mrpt::format(
        "its calibration is for %ux%u images, its depth image has %dx%d", camera.ncols,
        camera.nrows, static_cast<int>(columns), static_cast<int>(rows)));
}

/** Turns distances d along rays into depths: z = d / |ray of depth 1|. */
void rangesToDepths(CObservation3DRangeScan& scan)
{
  const auto& c = scan.cameraParams;
  for (int v = 0; v < scan.rangeImage.rows(); ++v)
    for (int u = 0; u < scan.rangeImage.cols(); ++u)
    {
      const double x = (u - c.cx()) / c.fx(), y = (v - c.cy()) / c.fy();
      auto& value = scan.rangeImage(v, u);
      value = static_cast<std::uint16_t>(std::lround(value / std::sqrt(1 + x * x + y * y)));
    }
  scan.range_is_depth = true;
}
}  // namespace

void prepareScan(CObservation3DRangeScan& scan, const std::string& imagesFolder)
{
  if (!scan.hasRangeImage)
    throw std::runtime_error(
        scan.hasPoints3D ? "has 3D points but no range image" : "has no range image");
  loadExternalImages(scan, imagesFolder);
  if (scan.rangeImage.rows() == 0 || scan.rangeImage.cols() == 0)
    throw std::runtime_error("its range image is empty");
  if (!isPlausibleDepthUnit(scan.rangeUnits))
    throw std::runtime_error(mrpt::format(
        "rangeUnits=%g: must be > 0 m, in [%g, %g] m", static_cast<double>(scan.rangeUnits),
        kSmallestDepthUnit, kLargestDepthUnit));
  requireCalibration(scan);
  if (!scan.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().allFinite())
    throw std::runtime_error("its sensorPose has numbers that are not finite");
  if (!scan.range_is_depth) rangesToDepths(scan);
}

std::vector<std::string> removeUnusableBoxes(CObservationObjects& boxes)
{
  std::vector<std::string> problems;
  std::vector<DetectedObject> usable;
  for (std::size_t i = 0; i < boxes.objects.size(); ++i)
  {
    auto& object = boxes.objects[i];
    const auto what =
        whyUnusable(object.box, object.score, boxes.cameraParams.ncols, boxes.cameraParams.nrows);
    if (what)
      problems.push_back(mrpt::format("box %zu (%s): ", i, object.label.c_str()) + *what);
    else
      usable.push_back(std::move(object));
  }
  boxes.objects = std::move(usable);
  return problems;
}

}  // namespace quadmap
