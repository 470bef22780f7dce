#include "GridCloud.h"

namespace quadmap
{
pointOperations::Points positionsOf(const PointGrid& grid, const std::vector<std::size_t>& cells)
{
  pointOperations::Points points;
  points.reserve(cells.size());
  for (const std::size_t cell : cells) points.push_back(grid.position(cell));
  return points;
}

std::vector<std::size_t> trustedCells(const PointGrid& grid, const DenseOptions& options)
{
  const std::vector<std::size_t> strong =
      grid.strongCells(options.minHits, static_cast<float>(options.minWeightShare));
  std::vector<std::size_t> trusted;
  for (const std::size_t i : pointOperations::withoutOutliers(
           positionsOf(grid, strong), options.outlierNeighbours, options.outlierDeviations))
    trusted.push_back(strong[i]);
  return trusted;
}

DenseCloud cloudOf(
    const PointGrid& grid, const std::vector<std::size_t>& cells, const DenseOptions& options)
{
  const auto normals =
      pointOperations::surfaceNormals(positionsOf(grid, cells), options.normalNeighbours);
  DenseCloud cloud(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const bool isAway = normals[i].normal.dot(grid.toCamera(cells[i])) < 0;
    cloud[i].position = grid.position(cells[i]);
    cloud[i].normal = isAway ? Eigen::Vector3f(-normals[i].normal) : normals[i].normal;
    cloud[i].curvature = normals[i].curvature;
    cloud[i].rgb = grid.rgb(cells[i]);
  }
  return cloud;
}

}  // namespace quadmap
