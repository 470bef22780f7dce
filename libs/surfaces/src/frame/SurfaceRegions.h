#pragma once

#include <Eigen/Dense>
#include <vector>

#include "frame/SurfaceCells.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** Connected cells on one plane. */
struct SurfaceRegion
{
  Plane plane;  //!< Optical frame, normal towards the camera
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  std::vector<std::size_t> cells;  //!< Indices, from the top of the image down
};

/** The plane regions of more than so many cells, the largest first. */
std::vector<SurfaceRegion> surfaceRegions(const SurfaceCells& cells, std::size_t minCells);

}  // namespace quadmap
