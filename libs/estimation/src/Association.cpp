#include "quadmap/estimation/Association.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "quadmap/estimation/Assignment.h"

namespace quadmap
{
namespace
{
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

double labelCount(const AssociationTarget& target, const std::string& label)
{
  for (const auto& [name, count] : target.labelCounts)
    if (name == label) return count;
  return 0;
}

/** The prior of an object, doc/mathematics.md, (12.1): ln m_i + ln (n_iu + beta)/(m_i + U beta). */
double logPrior(
    const AssociationCandidate& z, const AssociationTarget& object, const AssociationParameters& p)
{
  if (object.observations == 0) return kImpossible;
  const double m = object.observations;
  return std::log(m) + std::log((labelCount(object, z.label) + p.beta) / (m + p.labels * p.beta));
}

double logSumExp(const Eigen::VectorXd& v)
{
  const double top = v.maxCoeff();
  return std::isfinite(top) ? top + std::log((v.array() - top).exp().sum()) : top;
}

void requireValid(const AssociationParameters& p)
{
  if (!(p.alpha > 0) || !(p.beta > 0) || p.labels == 0 || !(p.newObjectVolume > 0) ||
      !(p.minJoinPosterior >= 0 && p.minJoinPosterior < 1))
    throw std::invalid_argument("associateFrame: alpha, beta, labels, volume must be > 0");
}

/** Adds the prior of the Dirichlet process to the log-likelihoods (rows: measurements, columns:
 * objects), doc/mathematics.md, (12.1). The last column is "none of them" (12.2): a new object, or
 * waiting. */
Eigen::MatrixXd unnormalisedLogPosterior(
    const std::vector<AssociationCandidate>& measurements,
    const std::vector<AssociationTarget>& targets,
    const AssociationParameters& p,
    const Eigen::MatrixXd& logLikelihood)
{
  const auto rows = static_cast<Eigen::Index>(measurements.size());
  const auto objects = static_cast<Eigen::Index>(targets.size());
  if (logLikelihood.rows() != rows || logLikelihood.cols() != objects)
    throw std::invalid_argument("associateFrame: the log-likelihoods have the wrong size");

  Eigen::MatrixXd log(rows, objects + 1);
  for (Eigen::Index k = 0; k < rows; ++k)
  {
    const auto& z = measurements[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < objects; ++i)
      log(k, i) = logLikelihood(k, i) + logPrior(z, targets[static_cast<std::size_t>(i)], p);
    log(k, objects) = std::log(p.alpha) - std::log(double(p.labels)) - std::log(p.newObjectVolume);
  }
  return log;
}

/** Costs of the assignment. Each row has its own "none" column, so that any number of boxes can be
 * new. */
Eigen::MatrixXd assignmentCost(const Eigen::MatrixXd& logPosterior, double minJoinPosterior)
{
  const Eigen::Index rows = logPosterior.rows(), objects = logPosterior.cols() - 1;
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, objects + rows, kForbiddenCost);
  for (Eigen::Index k = 0; k < rows; ++k)
  {
    for (Eigen::Index i = 0; i < objects; ++i)
      if (logPosterior(k, i) != kImpossible && std::exp(logPosterior(k, i)) >= minJoinPosterior)
        cost(k, i) = -logPosterior(k, i);
    cost(k, objects + k) = -logPosterior(k, objects);
  }
  return cost;
}

}  // namespace

double logGaussian(const Eigen::VectorXd& difference, const Eigen::MatrixXd& S)
{
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  if (llt.info() != Eigen::Success)
    throw std::invalid_argument("logGaussian: a covariance is not positive definite");
  const Eigen::VectorXd whitened = llt.matrixL().solve(difference);
  double halfLogDet = 0;
  for (Eigen::Index i = 0; i < S.rows(); ++i) halfLogDet += std::log(llt.matrixLLT()(i, i));
  const double dimension = static_cast<double>(difference.size());
  return -0.5 * whitened.squaredNorm() - halfLogDet - 0.5 * dimension * std::log(2.0 * M_PI);
}

std::vector<AssociationDecision> associateFrame(
    const std::vector<AssociationCandidate>& measurements,
    const std::vector<AssociationTarget>& targets,
    const AssociationParameters& parameters,
    const Eigen::MatrixXd& logLikelihood)
{
  requireValid(parameters);
  if (measurements.empty()) return {};

  Eigen::MatrixXd log = unnormalisedLogPosterior(measurements, targets, parameters, logLikelihood);
  for (Eigen::Index k = 0; k < log.rows(); ++k) log.row(k).array() -= logSumExp(log.row(k));

  const auto columns = optimalAssignment(assignmentCost(log, parameters.minJoinPosterior));
  std::vector<AssociationDecision> decisions;
  for (std::size_t k = 0; k < measurements.size(); ++k)
  {
    AssociationDecision d;
    d.measurement = k;
    const bool joins = columns[k] < targets.size();
    if (joins) d.target = columns[k];
    d.startsObject = !joins && measurements[k].mayStartObject;

    Eigen::VectorXd row = log.row(static_cast<Eigen::Index>(k));
    const auto chosen = static_cast<Eigen::Index>(joins ? columns[k] : targets.size());
    d.logPosterior = row[chosen];
    row[chosen] = kImpossible;
    d.logPosteriorSecond = row.maxCoeff();
    decisions.push_back(d);
  }
  return decisions;
}

}  // namespace quadmap
