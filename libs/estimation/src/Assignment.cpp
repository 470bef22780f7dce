#include "quadmap/estimation/Assignment.h"

#include <limits>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** Potentials and the current matching. Rows and columns count from 1, and index 0 stands for
 * "nothing". */
struct Matching
{
  std::vector<double> rowPotential, columnPotential;
  std::vector<std::size_t> rowOfColumn;

  Matching(std::size_t rows, std::size_t columns) :
      rowPotential(rows + 1, 0.0), columnPotential(columns + 1, 0.0), rowOfColumn(columns + 1, 0)
  {
  }
};

/** Adds one row to the matching along the shortest augmenting path. */
void augment(const Eigen::MatrixXd& cost, std::size_t row, Matching& m)
{
  const auto columns = static_cast<std::size_t>(cost.cols());
  std::vector<double> slack(columns + 1, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> previous(columns + 1, 0);
  std::vector<bool> visited(columns + 1, false);

  m.rowOfColumn[0] = row;
  std::size_t column = 0;
  do
  {
    visited[column] = true;
    const std::size_t r = m.rowOfColumn[column];
    double delta = std::numeric_limits<double>::infinity();
    std::size_t next = 0;
    for (std::size_t j = 1; j <= columns; ++j)
    {
      if (visited[j]) continue;
      const double reduced =
          cost(static_cast<Eigen::Index>(r - 1), static_cast<Eigen::Index>(j - 1)) -
          m.rowPotential[r] - m.columnPotential[j];
      if (reduced < slack[j])
      {
        slack[j] = reduced;
        previous[j] = column;
      }
      if (slack[j] < delta)
      {
        delta = slack[j];
        next = j;
      }
    }
    for (std::size_t j = 0; j <= columns; ++j)
    {
      if (visited[j])
      {
        m.rowPotential[m.rowOfColumn[j]] += delta;
        m.columnPotential[j] -= delta;
      }
      else
        slack[j] -= delta;
    }
    column = next;
  } while (m.rowOfColumn[column] != 0);

  for (; column != 0; column = previous[column])
    m.rowOfColumn[column] = m.rowOfColumn[previous[column]];
}

}  // namespace

std::vector<std::size_t> optimalAssignment(const Eigen::MatrixXd& cost)
{
  if (cost.rows() > cost.cols())
    throw std::invalid_argument("optimalAssignment: more rows than columns");
  if (!cost.allFinite()) throw std::invalid_argument("optimalAssignment: a cost is not finite");

  const auto rows = static_cast<std::size_t>(cost.rows());
  const auto columns = static_cast<std::size_t>(cost.cols());
  Matching matching(rows, columns);
  for (std::size_t row = 1; row <= rows; ++row) augment(cost, row, matching);

  std::vector<std::size_t> columnOfRow(rows, 0);
  for (std::size_t j = 1; j <= columns; ++j)
    if (matching.rowOfColumn[j] != 0) columnOfRow[matching.rowOfColumn[j] - 1] = j - 1;
  return columnOfRow;
}

}  // namespace quadmap
