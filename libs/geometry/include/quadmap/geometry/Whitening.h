#pragma once

#include <Eigen/Dense>
#include <stdexcept>

namespace quadmap
{
/** The lower triangular W with W^t W = covariance^-1: residuals W r have the covariance I.
 * \exception std::invalid_argument If the covariance is not positive definite. */
template <int N>
Eigen::Matrix<double, N, N> whiteningOf(const Eigen::Matrix<double, N, N>& covariance)
{
  using Matrix = Eigen::Matrix<double, N, N>;
  const Eigen::LLT<Matrix> llt(covariance);
  if (llt.info() != Eigen::Success || !covariance.allFinite())
    throw std::invalid_argument("a covariance is not positive definite");
  return llt.matrixL().solve(Matrix(Matrix::Identity()));
}

}  // namespace quadmap
