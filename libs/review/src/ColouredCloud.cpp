#include "quadmap/review/ColouredCloud.h"

#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/obs/T3DPointsProjectionParams.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace quadmap
{
namespace
{
constexpr double kGrowth = 1.25;  // factor by which cells grow at a time

/** The points of a frame in the order of its pixels, with (0, 0, 0) where there is no depth. */
struct OrganizedPoints
{
  int width = 0, height = 0;
  mrpt::maps::CColouredPointsMap points;  // in the frame of the robot

  bool isValid(int row, int column) const { return !at(row, column).isZero(); }
  std::size_t index(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  Eigen::Vector3f at(int row, int column) const
  {
    const std::size_t i = index(row, column);
    return {
        points.getPointsBufferRef_x()[i], points.getPointsBufferRef_y()[i],
        points.getPointsBufferRef_z()[i]};
  }
};

/** Every n-th row and column of the images, as a camera with larger pixels would have measured
 * them. A colour image of another camera stays as it is: points find their colours in it by
 * projection. */
mrpt::obs::CObservation3DRangeScan thinned(
    const mrpt::obs::CObservation3DRangeScan& scan, int stride)
{
  mrpt::obs::CObservation3DRangeScan out;
  out.sensorPose = scan.sensorPose;
  out.rangeUnits = scan.rangeUnits;
  out.range_is_depth = scan.range_is_depth;
  out.intensityImage = scan.intensityImage;
  out.hasIntensityImage = scan.hasIntensityImage;
  out.cameraParamsIntensity = scan.cameraParamsIntensity;
  out.relativePoseIntensityWRTDepth = scan.relativePoseIntensityWRTDepth;
  const auto rows = (scan.rangeImage.rows() + stride - 1) / stride;
  const auto columns = (scan.rangeImage.cols() + stride - 1) / stride;
  out.rangeImage_setSize(static_cast<int>(rows), static_cast<int>(columns));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      out.rangeImage(row, column) = scan.rangeImage(row * stride, column * stride);
  out.hasRangeImage = true;
  const mrpt::img::TCamera& c = scan.cameraParams;
  out.cameraParams = c;
  out.cameraParams.ncols = static_cast<std::uint32_t>(columns);
  out.cameraParams.nrows = static_cast<std::uint32_t>(rows);
  out.cameraParams.setIntrinsicParamsFromValues(
      c.fx() / stride, c.fy() / stride, c.cx() / stride, c.cy() / stride);
  if (!scan.hasIntensityImage || !scan.doDepthAndIntensityCamerasCoincide()) return out;
  const cv::Mat& image = scan.intensityImage.asCvMatRef();
  if (image.rows < scan.rangeImage.rows() || image.cols < scan.rangeImage.cols()) return out;

  out.cameraParamsIntensity = out.cameraParams;
  cv::Mat fewer(out.rangeImage.rows(), out.rangeImage.cols(), image.type());
  const auto pixel = image.elemSize();
  for (int row = 0; row < fewer.rows; ++row)
    for (int column = 0; column < fewer.cols; ++column)
      std::memcpy(fewer.ptr(row, column), image.ptr(row * stride, column * stride), pixel);
  out.intensityImage = mrpt::img::CImage(fewer, mrpt::img::SHALLOW_COPY);
  return out;
}

OrganizedPoints unproject(mrpt::obs::CObservation3DRangeScan& scan)
{
  OrganizedPoints out;
  out.width = static_cast<int>(scan.rangeImage.cols());
  out.height = static_cast<int>(scan.rangeImage.rows());
  out.points.colorScheme.scheme = mrpt::maps::CColouredPointsMap::cmFromIntensityImage;
  mrpt::obs::T3DPointsProjectionParams parameters;
  parameters.takeIntoAccountSensorPoseOnRobot = true;
  parameters.MAKE_ORGANIZED = true;
  scan.unprojectInto(out.points, parameters);
  return out;
}

/** Unit normal of the surface at a pixel, from its neighbours at the distance `step` to the right
 * and below. It is zero where they are missing or lie on another surface. */
Eigen::Vector3f normalAt(const OrganizedPoints& frame, int row, int column, int step)
{
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero();
  if (!frame.isValid(row, column + step) || !frame.isValid(row + step, column)) return zero;
  const Eigen::Vector3f p = frame.at(row, column);
  const Eigen::Vector3f right = frame.at(row, column + step) - p;
  const Eigen::Vector3f down = frame.at(row + step, column) - p;
  constexpr float kLargestStep = 0.15F;  // between neighbours on one surface [m]
  if (right.norm() > kLargestStep || down.norm() > kLargestStep) return zero;
  return right.cross(down).normalized();
}

}  // namespace

CloudCollector::CloudCollector(double cellSize, std::size_t maxPoints) :
    cellSize_(cellSize), maxPoints_(maxPoints)
{
  if (!(cellSize > 0) || maxPoints == 0)
    throw std::invalid_argument("point cloud: cell size and number of points must be positive");
}

/** The slot of a key, or the free one where it belongs: the next free one after that of its hash.
 */
std::size_t CloudCollector::Cells::slotOf(const Eigen::Vector3i& key) const
{
  const auto part = [&](int axis) { return static_cast<std::uint64_t>(key[axis]) & 0x1FFFFF; };
  std::uint64_t h = part(0) | part(1) << 21 | part(2) << 42;
  h = (h ^ (h >> 31)) * 0x9E3779B97F4A7C15;  // multiplication by the golden ratio mixes upwards
  std::size_t slot = (h >> 32) & (slots_.size() - 1);
  while (slots_[slot] != 0 && entries_[slots_[slot] - 1].key != key)
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void CloudCollector::Cells::enlarge()
{
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), 0);
  for (std::size_t i = 0; i < entries_.size(); ++i)
    slots_[slotOf(entries_[i].key)] = static_cast<std::uint32_t>(i + 1);
}

CloudCollector::Cell& CloudCollector::Cells::operator[](const Eigen::Vector3i& key)
{
  if (2 * entries_.size() >= slots_.size()) enlarge();
  std::uint32_t& slot = slots_[slotOf(key)];
  if (slot == 0)
  {
    entries_.push_back({key, {}});
    slot = static_cast<std::uint32_t>(entries_.size());
  }
  return entries_[slot - 1].cell;
}

Eigen::Vector3i CloudCollector::keyOf(const Eigen::Vector3f& p_map) const
{
  return (p_map.cast<double>() / cellSize_).array().floor().cast<int>();
}

void CloudCollector::add(
    mrpt::obs::CObservation3DRangeScan& scan,
    const mrpt::poses::CPose3D& T_map_robot,
    const Selection& selection)
{
  if (selection.stride > 1)
  {
    mrpt::obs::CObservation3DRangeScan fewer = thinned(scan, selection.stride);
    return addPoints(fewer, T_map_robot, selection);
  }
  addPoints(scan, T_map_robot, selection);
}

void CloudCollector::addPoints(
    mrpt::obs::CObservation3DRangeScan& scan,
    const mrpt::poses::CPose3D& T_map_robot,
    const Selection& selection)
{
  constexpr float kLookWeight = 0.4F;  // of the direction to the camera, against noise
  constexpr float kFarthest = 1e6F;    // of a map; cells are numbered [m]
  constexpr double kWide = 8;          // of the image, because depth is noisy [px]
  const int normalStep = std::max(1, static_cast<int>(std::lround(kWide / selection.stride)));
  const OrganizedPoints frame = unproject(scan);
  const Eigen::Matrix4f T =
      T_map_robot.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen().cast<float>();
  const auto& o = scan.sensorPose;
  const Eigen::Vector3f eye = Eigen::Vector3d(o.x(), o.y(), o.z()).cast<float>();
  for (int row = 0; row + normalStep < frame.height; ++row)
  {
    for (int column = 0; column + normalStep < frame.width; ++column)
    {
      if (!frame.isValid(row, column)) continue;
      const Eigen::Vector3f p_robot = frame.at(row, column);
      if ((p_robot - eye).norm() > static_cast<float>(selection.maxRange)) continue;
      Eigen::Vector3f n_robot = normalAt(frame, row, column, normalStep);
      if (n_robot.dot(eye - p_robot) < 0) n_robot = -n_robot;
      n_robot += kLookWeight * (eye - p_robot).normalized();

      const Eigen::Vector3f p_map = T.topLeftCorner<3, 3>() * p_robot + T.topRightCorner<3, 1>();
      if (!(p_map.cwiseAbs().maxCoeff() <= kFarthest)) continue;  // also what is not a number
      Cell& cell = cells_[keyOf(p_map)];
      cell.positionSum += p_map;
      cell.normalSum += T.topLeftCorner<3, 3>() * n_robot;
      Eigen::Vector3f rgb;
      frame.points.getPointColor(frame.index(row, column), rgb.x(), rgb.y(), rgb.z());
      cell.rgbSum += rgb;
      cell.count += 1;
    }
  }
  scan.resizePoints3DVectors(0);
  ++frames_;
  while (cells_.size() > maxPoints_) growCells();
}

void CloudCollector::closeGaps(double largest)
{
  constexpr double kSeveral = 8;  // mean number of points per cell
  double hits = 0;
  for (const auto& entry : cells_.entries()) hits += static_cast<double>(entry.cell.count);
  while (hits < kSeveral * static_cast<double>(cells_.size()) && cellSize_ * kGrowth <= largest)
    growCells();
}

void CloudCollector::growCells()
{
  cellSize_ *= kGrowth;
  Cells coarse;
  for (const auto& entry : cells_.entries())
  {
    const Cell& from = entry.cell;
    Cell& to = coarse[keyOf(from.positionSum / from.count)];
    to.positionSum += from.positionSum;
    to.normalSum += from.normalSum;
    to.rgbSum += from.rgbSum;
    to.count += from.count;
  }
  cells_ = std::move(coarse);
}

Cloud CloudCollector::points() const
{
  // Cells with a single point are mostly noise at jumps in depth, but not when there are few
  // frames.
  const float fewestHits = frames_ < 10 ? 1.0F : 2.0F;
  Cloud out;
  out.reserve(cells_.size());
  for (const auto& entry : cells_.entries())
  {
    const Cell& cell = entry.cell;
    if (cell.count < fewestHits) continue;
    CloudPoint p;
    p.position = cell.positionSum / cell.count;
    p.normal = cell.normalSum.isZero() ? cell.normalSum : cell.normalSum.normalized();
    for (int i = 0; i < 3; ++i)
      p.rgb[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(255.0F * cell.rgbSum[i] / cell.count);
    out.push_back(p);
  }
  return out;
}

}  // namespace quadmap
