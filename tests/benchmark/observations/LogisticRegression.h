#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace quadmap::observations
{
/** Weights of a logistic model, with their standard deviations. */
struct LogisticFit
{
  Eigen::VectorXd weights, sigmas;
};

/** Maximum likelihood weights w of P(y = 1) = 1 / (1 + exp(-xᵗw)), by Newton's method.
 * \param x A row for each example.
 * \param y Whether it was so: 0 or 1.
 * \exception std::runtime_error If there are none of a kind, or a column tells them apart. */
inline LogisticFit fitLogistic(const Eigen::MatrixXd& x, const Eigen::VectorXd& y)
{
  constexpr int kMostSteps = 50;
  constexpr double kConverged = 1e-8, kSingular = 1e-12;
  Eigen::VectorXd w = Eigen::VectorXd::Zero(x.cols());
  for (int step = 0; step < kMostSteps; ++step)
  {
    const Eigen::ArrayXd p = 1.0 / (1.0 + (-(x * w).array()).exp());
    const Eigen::MatrixXd information = x.transpose() * (p * (1.0 - p)).matrix().asDiagonal() * x;
    const Eigen::LDLT<Eigen::MatrixXd> solver(information);
    const Eigen::VectorXd pivots = solver.vectorD();
    if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) break;
    const Eigen::VectorXd change = solver.solve(x.transpose() * (y - p.matrix()));
    w += change;
    if (!w.allFinite()) break;
    if (change.cwiseAbs().maxCoeff() > kConverged) continue;
    const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
    return {w, covariance.diagonal().cwiseSqrt()};
  }
  throw std::runtime_error("the weights of a logistic regression are not determined");
}

}  // namespace quadmap::observations
