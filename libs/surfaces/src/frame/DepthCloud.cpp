#include "quadmap/surfaces/DepthCloud.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "frame/FrameNoise.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/obs/FrameAgreement.h"

namespace quadmap
{
namespace
{
constexpr int kWorkingColumns = 320;  // planes and objects need no more; see doc/benchmarks.md

void requireDepth(const mrpt::obs::CObservation3DRangeScan& scan)
{
  if (!scan.hasRangeImage || scan.rangeImage.rows() == 0 || scan.rangeImage.cols() == 0)
    throw std::runtime_error("the scan of sensor \"" + scan.sensorLabel + "\" has no depth image");
  const std::string whose = "the scan of sensor \"" + scan.sensorLabel + "\"";
  const auto& camera = scan.cameraParams;
  requireCalibration(camera, whose);
  const auto rows = static_cast<unsigned>(scan.rangeImage.rows());
  const auto columns = static_cast<unsigned>(scan.rangeImage.cols());
  if (camera.ncols != columns || camera.nrows != rows)
    throw std::runtime_error(
        whose + mrpt::format(
                    " has a calibration for %ux%u images and a depth image of %ux%u", camera.ncols,
                    camera.nrows, columns, rows));
}

}  // namespace

DepthCloud::DepthCloud(
    const mrpt::obs::CObservation3DRangeScan& scan, const SurfaceOptions& options) :
    noise_(options.depthNoise)
{
  requireDepth(scan);
  const auto& range = scan.rangeImage;
  const int width = static_cast<int>(range.cols()), height = static_cast<int>(range.rows());
  camera_ = pinholeFrom(scan.cameraParams);

  stride_ = std::max(1, width / kWorkingColumns);
  columns_ = width / stride_;
  rows_ = height / stride_;
  for (int c = 0; c < columns_; ++c)
    rayX_.push_back(static_cast<float>((c * stride_ - camera_.cx) / camera_.fx));
  for (int r = 0; r < rows_; ++r)
    rayY_.push_back(static_cast<float>((r * stride_ - camera_.cy) / camera_.fy));

  depth_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const float minRange = static_cast<float>(options.minRange);
  const float maxRange = static_cast<float>(options.maxRange);
  for (int r = 0; r < rows_; ++r)
  {
    const auto* row = &range(r * stride_, 0);
    float* cells = &depth_[index(0, r)];
    for (int c = 0; c < columns_; ++c)
    {
      float z = static_cast<float>(row[c * stride_]) * scan.rangeUnits;
      if (!scan.range_is_depth)
        z /= std::sqrt(
            1.f + rayX_[std::size_t(c)] * rayX_[std::size_t(c)] +
            rayY_[std::size_t(r)] * rayY_[std::size_t(r)]);
      cells[c] = z >= minRange && z <= maxRange ? z : 0.f;
    }
  }
  constexpr int kSparse = 4;
  for (int r = 0; r < rows_; r += kSparse)
    for (int c = 0; c < columns_; c += kSparse)
      if (valid(c, r)) sparsePoints_.push_back(point(c, r).cast<double>());
  if (options.maxDepthNoiseFactor > 1)
    noise_ = noise_.times(noiseFactor(*this, options.maxDepthNoiseFactor));
}

int DepthCloud::normalReach(float z) const
{
  // Shorter base lines drown in the quantisation of depth and in its noise.
  constexpr double kMinBase = 0.03, kSigmas = 2.0;  // [m], of depth
  const double base = std::max(kMinBase, kSigmas * noise_.sigma(double(z)));
  const double cellsPerMetre = std::abs(camera_.fx) / (double(z) * stride_);
  return std::clamp(static_cast<int>(base * cellsPerMetre + 0.5), 2, 8);
}

double DepthCloud::cellsPerNormal(double z) const
{
  const double reach = normalReach(static_cast<float>(z));
  return reach * reach;
}

std::optional<Eigen::Vector3f> DepthCloud::normal(int c, int r) const
{
  const float z = depth(c, r);
  if (!(z > 0)) return {};
  const int k = normalReach(z);
  if (!inside(c - k, r - k) || !inside(c + k, r + k)) return {};

  const float tolerance = jumpTolerance(z) + 0.04f;
  const float* here = &depth_[index(c, r)];
  const float *rayX = &rayX_[static_cast<std::size_t>(c)], *rayY = &rayY_[std::size_t(r)];
  // Differences between points to the left and right, above and below, in three lines each way.
  Eigen::Vector3f horizontal = Eigen::Vector3f::Zero(), vertical = Eigen::Vector3f::Zero();
  int used = 0;
  for (int s = -1; s <= 1; ++s)
  {
    const int o = s * (k / 2);
    const float left = here[o * columns_ - k], right = here[o * columns_ + k];
    const float above = here[o - k * columns_], below = here[o + k * columns_];
    const float nearest = std::min(std::min(left, right), std::min(above, below));
    const float farthest = std::max(std::max(left, right), std::max(above, below));
    if (!(nearest > 0 && z - nearest < tolerance && farthest - z < tolerance)) continue;
    horizontal +=
        Eigen::Vector3f(rayX[k] * right - rayX[-k] * left, rayY[o] * (right - left), right - left);
    vertical += Eigen::Vector3f(
        rayX[o] * (below - above), rayY[k] * below - rayY[-k] * above, below - above);
    ++used;
  }
  if (used == 0) return {};
  Eigen::Vector3f n = horizontal.cross(vertical);
  const float length = n.norm();
  if (!(length > 1e-9f)) return {};
  n /= length;
  return n.dot(point(c, r)) > 0 ? Eigen::Vector3f(-n) : n;
}

bool DepthCloud::isAmongJumps(int c, int r) const
{
  const float z = depth(c, r), tolerance = jumpTolerance(z);
  int near = -1, valid = -1;  // but for the cell itself
  const int endC = std::min(c + 2, columns_), endR = std::min(r + 2, rows_);
  for (int rn = std::max(r - 1, 0); rn < endR; ++rn)
    for (int cn = std::max(c - 1, 0); cn < endC; ++cn)
    {
      const float zn = depth(cn, rn);
      valid += zn > 0 ? 1 : 0;
      near += zn > 0 && std::abs(zn - z) < tolerance ? 1 : 0;
    }
  return valid > near && near < 4;
}

DepthCloud::CellRange DepthCloud::cellsOf(const ImageBox& box) const
{
  const auto cell = [this](double pixel) { return static_cast<int>(std::ceil(pixel / stride_)); };
  const ImageBox b = box.clipped(camera_.width, camera_.height);
  if (!b.isValid()) return {};
  return {
      cell(b.x1), cell(b.y1), std::min(columns_, cell(b.x2 + 1e-9)),
      std::min(rows_, cell(b.y2 + 1e-9))};
}

CoarseDepth DepthCloud::coarse(unsigned columns, unsigned rows) const
{
  CoarseDepth out;
  out.columns = columns;
  out.rows = rows;
  std::vector<float> values;
  for (unsigned i = 0; i < rows; ++i)
    for (unsigned j = 0; j < columns; ++j)
    {
      values.clear();
      const int r1 = static_cast<int>((i + 1) * static_cast<unsigned>(rows_) / rows);
      const int c1 = static_cast<int>((j + 1) * static_cast<unsigned>(columns_) / columns);
      constexpr int kStep = 3;
      for (int r = static_cast<int>(i * static_cast<unsigned>(rows_) / rows); r < r1; r += kStep)
        for (int c = static_cast<int>(j * static_cast<unsigned>(columns_) / columns); c < c1;
             c += kStep)
          if (valid(c, r)) values.push_back(depth(c, r));
      if (values.size() < 3)
      {
        out.depth.push_back(0.f);
        continue;
      }
      out.depth.push_back(medianElement(values));
    }
  return out;
}

}  // namespace quadmap
