#include "rawlog/ScanCheck.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/InsideFolder.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/sensors/BoxCheck.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/DepthUnit.h"
#include "quadmap/sensors/EncodedImage.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;
using mrpt::obs::CObservation3DRangeScan;

/** The path of an external image. A rawlog may come from somebody else, and what it names ends up
 * in the results, which are passed on. \exception std::runtime_error If it leads out of the folder,
 * be it by name or by a link, which the image folder may be itself, or nowhere. */
std::string pathOf(const std::string& name, const ImageRules& rules)
{
  if (name.find('\0') != std::string::npos)
    throw std::runtime_error(
        "its external image " + oneLine(name) + " has a zero byte in its name");
  const fs::path path = fs::path(rules.folder) / name;  // an absolute name stays as it is
  if (!rules.imagesAnywhere)
    for (const std::string& folder : {rules.folder, rules.rawlogFolder})
      if (!isInside(path, folder))
        throw std::runtime_error(
            "its external image " + name + " lies outside " + folder +
            (rules.imagesHint.empty() ? "" : " (" + rules.imagesHint + " would allow that)"));
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    throw std::runtime_error("its external image " + path.string() + " is missing");
  return path.string();
}

/** Loads an external depth image of MRPT, a gzip file of rows and columns (4 bytes each) and 16
 * bits per pixel. MRPT's own loader crashes on damaged files. */
void loadDepthFile(const std::string& path, std::uint64_t mostPixels, CObservation3DRangeScan& scan)
{
  GzInput file(path, false);
  std::uint32_t size[2] = {0, 0};
  if (file.Read(size, sizeof size) == 0) throw std::runtime_error("it is empty");
  const auto [rows, columns] = size;
  if (rows < 1 || columns < 1 || std::uint64_t{rows} * columns > mostPixels)
    throw std::runtime_error(mrpt::format("a size of %ux%u is not plausible", columns, rows));
  scan.rangeImage_setSize(static_cast<int>(rows), static_cast<int>(columns));
  const std::size_t bytes = std::size_t{rows} * columns * sizeof(std::uint16_t);
  file.Read(scan.rangeImage.data(), bytes);
}

/** The numbers of a row of a text, as MRPT writes and reads them. */
std::vector<std::uint16_t> depthsIn(const std::string& row)
{
  std::vector<std::uint16_t> depths;
  if (row.find('\0') != std::string::npos) throw std::runtime_error("it has a zero byte");
  if (row[0] == '%' || row[0] == '#') return depths;  // a comment
  const char* next = row.c_str();
  while (next += std::strspn(next, " \t\r,"), *next != '\0')
  {
    char* end = nullptr;
    const double depth = std::strtod(next, &end);
    if (end == next || !(depth >= 0 && depth <= std::numeric_limits<std::uint16_t>::max()))
      throw std::runtime_error("it holds something that is no depth of 0 to 65535");
    if (depths.size() == kLongestImageSide) throw std::runtime_error("a row is too long");
    depths.push_back(static_cast<std::uint16_t>(depth));
    next = end;
  }
  return depths;
}

/** Loads an external depth image as a text. MRPT takes 20 bytes of memory for each number of one,
 * however many there are. */
void loadDepthText(const std::string& path, std::uint64_t mostPixels, CObservation3DRangeScan& scan)
{
  if (fs::file_size(path) > 8 * mostPixels) throw std::runtime_error("it is too large");
  std::ifstream file(path);
  std::vector<std::uint16_t> pixels;
  std::size_t rows = 0, columns = 0;
  for (std::string row; std::getline(file, row);)
  {
    const auto depths = depthsIn(row);
    if (depths.empty()) continue;
    if (rows++ == 0) columns = depths.size();
    if (depths.size() != columns) throw std::runtime_error("its rows differ in length");
    if (rows > kLongestImageSide || rows * columns > mostPixels)
      throw std::runtime_error(mrpt::format("it has %zu or more rows of %zu", rows, columns));
    pixels.insert(pixels.end(), depths.begin(), depths.end());
  }
  scan.rangeImage_setSize(static_cast<int>(rows), static_cast<int>(columns));
  std::copy(pixels.begin(), pixels.end(), scan.rangeImage.data());
}

void loadExternalDepth(CObservation3DRangeScan& scan, const ImageRules& rules)
{
  const std::string path = pathOf(scan.rangeImage_getExternalStorageFile(""), rules);
  try
  {
    if (fs::path(path).extension() == ".txt")
      loadDepthText(path, rules.mostPixels, scan);
    else
      loadDepthFile(path, rules.mostPixels, scan);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error("its external image " + path + " cannot be read: " + rootMessage(e));
  }
  scan.rangeImage_forceResetExternalStorage();
}

void loadExternalColor(CObservation3DRangeScan& scan, const ImageRules& rules)
{
  const std::string path = pathOf(scan.intensityImage.getExternalStorageFile(), rules);
  try
  {
    const cv::Mat image = decodeImageFile(path, cv::IMREAD_COLOR, rules.mostPixels);
    scan.intensityImage = mrpt::img::CImage(image, mrpt::img::SHALLOW_COPY);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error("its external image " + path + " " + rootMessage(e));
  }
}

/** Loads the external images into the scan. */
void loadExternalImages(CObservation3DRangeScan& scan, const ImageRules& rules)
{
  if (scan.rangeImage_isExternallyStored()) loadExternalDepth(scan, rules);
  if (scan.hasIntensityImage && scan.intensityImage.isExternallyStored())
    loadExternalColor(scan, rules);
}

/** Nothing uses confidences, and MRPT would read whatever file an external image of them names. */
void dropExternalConfidence(CObservation3DRangeScan& scan)
{
  if (!scan.hasConfidenceImage || !scan.confidenceImage.isExternallyStored()) return;
  scan.confidenceImage = mrpt::img::CImage();
  scan.hasConfidenceImage = false;
}

void requireCalibration(const CObservation3DRangeScan& scan)
{
  const auto& camera = scan.cameraParams;
  if (const auto why = whyNoCalibration(camera)) throw std::runtime_error(*why);
  const auto rows = scan.rangeImage.rows(), columns = scan.rangeImage.cols();
  if (static_cast<int>(camera.nrows) != rows || static_cast<int>(camera.ncols) != columns)
    throw std::runtime_error(mrpt::format(
        "its calibration is for %ux%u images, its depth image has %dx%d", camera.ncols,
        camera.nrows, static_cast<int>(columns), static_cast<int>(rows)));
}

void requirePoses(const CObservation3DRangeScan& scan)
{
  if (const auto why = whyNoPose(scan.sensorPose, kFarthestOnRobot))
    throw std::runtime_error("its sensorPose " + *why);
  if (!scan.hasIntensityImage) return;
  if (const auto why = whyNoPose(scan.relativePoseIntensityWRTDepth, kFarthestOnRobot))
    throw std::runtime_error("its relativePoseIntensityWRTDepth " + *why);
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

void prepareScan(CObservation3DRangeScan& scan, const ImageRules& rules)
{
  if (!scan.hasRangeImage)
    throw std::runtime_error(
        scan.hasPoints3D ? "has 3D points but no range image" : "has no range image");
  loadExternalImages(scan, rules);
  dropExternalConfidence(scan);
  if (scan.rangeImage.rows() == 0 || scan.rangeImage.cols() == 0)
    throw std::runtime_error("its range image is empty");
  if (!isPlausibleDepthUnit(scan.rangeUnits))
    throw std::runtime_error(mrpt::format(
        "rangeUnits=%g: must be > 0 m, in [%g, %g] m", static_cast<double>(scan.rangeUnits),
        kSmallestDepthUnit, kLargestDepthUnit));
  requireCalibration(scan);
  requirePoses(scan);
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
