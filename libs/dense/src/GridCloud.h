#pragma once

#include <cstddef>
#include <vector>

#include "PointGrid.h"
#include "PointOperations.h"
#include "quadmap/dense/DenseCloud.h"
#include "quadmap/dense/DenseOptions.h"

namespace quadmap
{
/** Positions of some cells of a grid. */
pointOperations::Points positionsOf(const PointGrid& grid, const std::vector<std::size_t>& cells);

/** The cells of a grid with enough points and weight that are no outliers, ascending. */
std::vector<std::size_t> trustedCells(const PointGrid& grid, const DenseOptions& options);

/** Some cells of a grid as points with normals. */
DenseCloud cloudOf(
    const PointGrid& grid, const std::vector<std::size_t>& cells, const DenseOptions& options);

}  // namespace quadmap
