#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <vector>

namespace quadmap
{
/** The entries of H^-1 where H or its factor have any, which are all that marginal covariances
 * need, at about the cost of one factorisation: H^-1 as a whole is dense.
 *
 * With H = L D L^t, Z = H^-1 satisfies Z = D^-1 L^-1 + (I - L^t) Z; its columns follow from the
 * last to the first, and each needs only such entries of later ones [Takahashi, Fagan, Chen, 1973].
 */
class SparseInverse
{
 public:
  /** \param factorised Successfully. */
  explicit SparseInverse(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factorised);

  /** Rows and columns [first, first + size) of H^-1; H has entries all over this block. */
  Eigen::MatrixXd block(Eigen::Index first, Eigen::Index size) const;
  /** Rows [row, row + size) and columns [column, column + size) of H^-1, likewise. */
  Eigen::MatrixXd block(Eigen::Index row, Eigen::Index column, Eigen::Index size) const;

 private:
  double at(Eigen::Index row, Eigen::Index column) const;

  Eigen::VectorXi order_;              //!< Place of each variable in the factor
  Eigen::SparseMatrix<double> lower_;  //!< Z below the diagonal, in the factor's order
  Eigen::VectorXd diagonal_;
};

}  // namespace quadmap
