#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** A cell with the plane through the cells around it, in the optical frame. */
struct SurfaceCell
{
  Eigen::Vector3f point = Eigen::Vector3f::Zero();   //!< [m]; z = 0: no depth
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  //!< Unit, towards the camera; 0: no plane
  float offset = 0;                                  //!< Of the plane normal.x + offset = 0 [m]
  float roughness = 1;  //!< Share of the points' variance that is across the plane

  bool hasDepth() const { return point.z() > 0; }
  bool hasPlane() const { return offset > 0; }
};

/** Every kStride-th cell of every kStride-th row of a cloud. No plane reaches across a jump in
 * depth: cells beside one have none. */
class SurfaceCells
{
 public:
  static constexpr int kStride = 2;  //!< Of the cloud's cells: 160x120 for the usual sensors

  explicit SurfaceCells(const DepthCloud& cloud);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t size() const { return cells_.size(); }
  const SurfaceCell& operator[](std::size_t index) const { return cells_[index]; }  //!< Row by row

 private:
  std::vector<int> distancesToJumps() const;
  void fitPlanes(const DepthCloud& cloud);

  int columns_, rows_;
  std::vector<SurfaceCell> cells_;
};

}  // namespace quadmap
