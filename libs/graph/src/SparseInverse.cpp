#include "SparseInverse.h"

#include <algorithm>

namespace quadmap
{
using Eigen::Index;

SparseInverse::SparseInverse(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factorised) :
    order_(factorised.permutationP().indices()),
    lower_(factorised.matrixL().nestedExpression()),
    diagonal_(factorised.vectorD().cwiseInverse())
{
  // From the last column to the first, each column of L becomes that of Z in place,
  // doc/mathematics.md, (16.14) and (16.15):
  //   Z(s, j) = -Z(s, s) l,  Z(j, j) = 1 / D(j) - l^t Z(s, j),  l = L(s, j), s the rows it has.
  const Index n = diagonal_.size();
  Eigen::VectorXd l = Eigen::VectorXd::Zero(n), z = Eigen::VectorXd::Zero(n);
  double* values = lower_.valuePtr();
  const int *rows = lower_.innerIndexPtr(), *starts = lower_.outerIndexPtr();
  for (Index j = n - 1; j >= 0; --j)
  {
    const int begin = starts[j], end = starts[j + 1];
    for (int p = begin; p < end; ++p)
    {
      l[rows[p]] = values[p];
      z[rows[p]] = 0;  // what other rows hold is never read
    }
    for (int p = begin; p < end; ++p)
    {
      const int k = rows[p];
      double sum = diagonal_[k] * values[p];
      for (int q = starts[k]; q < starts[k + 1]; ++q)
      {
        sum += values[q] * l[rows[q]];
        z[rows[q]] -= values[q] * values[p];
      }
      z[k] -= sum;
    }
    for (int p = begin; p < end; ++p)
    {
      diagonal_[j] -= values[p] * z[rows[p]];
      values[p] = z[rows[p]];
      l[rows[p]] = 0;
    }
  }
}

double SparseInverse::at(Index row, Index column) const
{
  if (row == column) return diagonal_[row];
  return lower_.coeff(std::max(row, column), std::min(row, column));
}

Eigen::MatrixXd SparseInverse::block(Index first, Index size) const
{
  return block(first, first, size);
}

Eigen::MatrixXd SparseInverse::block(Index row, Index column, Index size) const
{
  Eigen::MatrixXd result(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j) result(i, j) = at(order_[row + i], order_[column + j]);
  return result;
}

}  // namespace quadmap
