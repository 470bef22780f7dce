#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace quadmap
{
/** Cost of a pairing that must not happen. */
constexpr double kForbiddenCost = 1e12;

/** Optimal assignment of every row to its own column: minimises the sum of the chosen costs
 * (shortest augmenting paths, O(rows^2 columns)).
 * \param cost rows x columns, rows <= columns, finite; kForbiddenCost marks impossible pairs.
 * \return The column of each row.
 * \exception std::invalid_argument If there are more rows than columns or a cost is not finite. */
std::vector<std::size_t> optimalAssignment(const Eigen::MatrixXd& cost);

}  // namespace quadmap
