#pragma once

#include <Eigen/Core>

// Decompositions for tests. They are compiled once, for matrices of any size: those of fixed size
// take the compiler ten seconds in each test that uses them.
namespace quadmap
{
/** e^t S^-1 e: the squared error over what a covariance claims. */
double squaredError(const Eigen::VectorXd& e, const Eigen::MatrixXd& S);

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A);
double determinantOf(const Eigen::MatrixXd& A);

/** The lower triangular L with L L^t = S, for a symmetric positive definite S. */
Eigen::MatrixXd rootOf(const Eigen::MatrixXd& S);

/** An orthogonal matrix, random as far as A is. */
Eigen::MatrixXd orthogonalOf(const Eigen::MatrixXd& A);

/** Eigenvalues of a symmetric matrix, the least one first, and their vectors. */
Eigen::VectorXd eigenvaluesOf(const Eigen::MatrixXd& S);
Eigen::MatrixXd eigenvectorsOf(const Eigen::MatrixXd& S);

/** The rotation and translation that bring points nearest to others, as a homogeneous matrix.
 * Points are columns.
 */
Eigen::MatrixXd rigidAlignment(const Eigen::MatrixXd& points, const Eigen::MatrixXd& others);

}  // namespace quadmap
