#include "Algebra.h"

#include <Eigen/Dense>

namespace quadmap
{
double squaredError(const Eigen::VectorXd& e, const Eigen::MatrixXd& S)
{
  return e.dot(S.llt().solve(e));
}

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& A) { return A.inverse(); }

double determinantOf(const Eigen::MatrixXd& A) { return A.determinant(); }

Eigen::MatrixXd rootOf(const Eigen::MatrixXd& S) { return S.llt().matrixL(); }

Eigen::MatrixXd orthogonalOf(const Eigen::MatrixXd& A)
{
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
}

Eigen::VectorXd eigenvaluesOf(const Eigen::MatrixXd& S)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXd eigenvectorsOf(const Eigen::MatrixXd& S)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S).eigenvectors();
}

Eigen::MatrixXd rigidAlignment(const Eigen::MatrixXd& points, const Eigen::MatrixXd& others)
{
  return Eigen::umeyama(points, others, false);
}

}  // namespace quadmap
