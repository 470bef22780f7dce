#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
/** A depth image as an organised cloud in the optical frame, at about 320x240. Cells without a
 * trusted depth have z = 0. */
class DepthCloud
{
 public:
  /** \exception std::runtime_error If the scan has no depth image or no usable calibration. */
  DepthCloud(const mrpt::obs::CObservation3DRangeScan& scan, const SurfaceOptions& options);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int stride() const { return stride_; }                   //!< Image pixels per cell
  const PinholeCamera& camera() const { return camera_; }  //!< Of the full image

  bool inside(int c, int r) const { return c >= 0 && r >= 0 && c < columns_ && r < rows_; }
  float depth(int c, int r) const { return depth_[index(c, r)]; }  //!< [m], 0 = none
  bool valid(int c, int r) const { return depth(c, r) > 0; }

  /** Point of a valid cell, optical frame [m]. */
  Eigen::Vector3f point(int c, int r) const
  {
    const float z = depth(c, r);
    return {rayX_[static_cast<std::size_t>(c)] * z, rayY_[static_cast<std::size_t>(r)] * z, z};
  }

  /** What the depths err by: the noise of the options, times the factor that the image shows. */
  const DepthNoise& noise() const { return noise_; }

  /** Points of every fourth valid cell of every fourth row [m]: statistics over the whole frame
   * need no more than these 5000. */
  const std::vector<Eigen::Vector3d>& sparsePoints() const { return sparsePoints_; }

  /** Unit normal of the surface at a cell, towards the camera, from differences over about 6 cm,
   * or more where the noise is larger; nothing at depth edges. */
  std::optional<Eigen::Vector3f> normal(int c, int r) const;

  /** Cells whose normals share their noise, at a depth [m]. */
  double cellsPerNormal(double z) const;

  /** Between a near and a far surface, on neither: an artefact of the sensor. */
  bool isFlyingPixel(int c, int r) const
  {
    // Most cells lie within a surface: four near neighbours settle it.
    return !(c > 0 && r > 0 && c + 1 < columns_ && r + 1 < rows_ && isWithinSurface(c, r)) &&
           isAmongJumps(c, r);
  }

  /** Cells of an image box, clipped: first column and row, one past the last ones. */
  struct CellRange
  {
    int c0 = 0, r0 = 0, c1 = 0, r1 = 0;
    bool contains(int c, int r) const { return c >= c0 && r >= r0 && c < c1 && r < r1; }
    int cells() const { return c1 > c0 && r1 > r0 ? (c1 - c0) * (r1 - r0) : 0; }
  };
  CellRange cellsOf(const ImageBox& box) const;

  CoarseDepth coarse(unsigned columns, unsigned rows) const;

 private:
  int normalReach(float z) const;  // cells to either side

  /** Two neighbouring depths on one surface: differences grow with range and slope [m]. */
  static float jumpTolerance(float z) { return 0.015f + 0.015f * z; }
  bool isWithinSurface(int c, int r) const
  {
    const float* cell = &depth_[index(c, r)];
    const float z = *cell, tolerance = jumpTolerance(z);  // < z: cells without depth are not near
    return std::abs(cell[-1] - z) < tolerance && std::abs(cell[1] - z) < tolerance &&
           std::abs(cell[-columns_] - z) < tolerance && std::abs(cell[columns_] - z) < tolerance;
  }
  bool isAmongJumps(int c, int r) const;
  std::size_t index(int c, int r) const { return static_cast<std::size_t>(r * columns_ + c); }

  PinholeCamera camera_;
  DepthNoise noise_;
  int stride_ = 1, columns_ = 0, rows_ = 0;
  std::vector<float> depth_, rayX_, rayY_;
  std::vector<Eigen::Vector3d> sparsePoints_;
};

/** Step over rows and columns with which some cells are looked at: about `count` of them, at most
 * 2.25 times as many. */
inline int stepFor(int cells, int count)
{
  return std::max(1, static_cast<int>(std::lround(std::sqrt(cells / static_cast<double>(count)))));
}

}  // namespace quadmap
