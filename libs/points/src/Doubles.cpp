#include "Doubles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/estimation/Association.h"

namespace quadmap
{
namespace
{
using Pair = std::pair<std::size_t, std::size_t>;

constexpr std::size_t kMaxFirstPairs = 30;  // first pairs that are tried, the likeliest first
constexpr double kMinGain = 1.0;            // of one more pair [log-odds]
/** Share of a correction that stays uncertain, because positions depend linearly on each other only
 * for small turns. */
constexpr double kNonlinearity = 0.05;

/** ln P of label counts that were drawn in one given order: doc/mathematics.md, (18.6). */
double logDirichletMultinomial(
    const std::map<std::string, unsigned>& counts, double beta, unsigned labels)
{
  double total = 0, log = 0;
  for (const auto& [label, n] : counts)
  {
    log += std::lgamma(n + beta) - std::lgamma(beta);
    total += n;
  }
  return log + std::lgamma(labels * beta) - std::lgamma(total + labels * beta);
}

struct Candidate
{
  Pair pair;
  double prior = 0;  //!< Log-odds of the labels minus ln(density)
  double gain = 0;   //!< Log-odds of this pair alone
};

/** Positions and their covariance, on condition that the joined pairs are one object each. */
class Conditioned
{
 public:
  explicit Conditioned(const DoublesProblem& problem) :
      P_(problem.covariance), leastSigma_(problem.leastSigma)
  {
    dimension_ = problem.objects.front().position.size();
    x_.resize(P_.rows());
    for (std::size_t i = 0; i < problem.objects.size(); ++i)
      x_.segment(row(i), dimension_) = problem.objects[i].position;
  }

  /** Log-odds of one more pair: doc/mathematics.md, (18.4). */
  double gain(const Candidate& c) const
  {
    return logGaussian(difference(c.pair), covariance(c.pair)) + c.prior;
  }

  double misfit(const Pair& pair) const
  {
    const Eigen::VectorXd d = difference(pair);
    return 0.5 * d.dot(covariance(pair).llt().solve(d));
  }

  /** Conditions all positions on the pair: doc/mathematics.md, (18.7). */
  void join(const Pair& pair)
  {
    const Eigen::VectorXd d = difference(pair);
    const Eigen::MatrixXd PHt =
        P_.middleCols(row(pair.first), dimension_) - P_.middleCols(row(pair.second), dimension_);
    const Eigen::MatrixXd K = PHt * covariance(pair).inverse();
    correction_ = std::max(correction_, d.norm());
    x_ -= K * d;
    P_.noalias() -= K * PHt.transpose();
  }

 private:
  Eigen::Index row(std::size_t i) const { return dimension_ * static_cast<Eigen::Index>(i); }
  Eigen::VectorXd difference(const Pair& p) const
  {
    return x_.segment(row(p.first), dimension_) - x_.segment(row(p.second), dimension_);
  }
  /** Covariance of the difference: doc/mathematics.md, (18.5). */
  Eigen::MatrixXd covariance(const Pair& p) const
  {
    const auto block = [&](std::size_t i, std::size_t j)
    { return P_.block(row(i), row(j), dimension_, dimension_); };
    const double sigma = std::hypot(leastSigma_, kNonlinearity * correction_);
    return block(p.first, p.first) + block(p.second, p.second) - block(p.first, p.second) -
           block(p.second, p.first) +
           sigma * sigma * Eigen::MatrixXd::Identity(dimension_, dimension_);
  }

  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
  Eigen::Index dimension_ = 0;
  double leastSigma_ = 0;  // least standard deviation of a difference [m]
  double correction_ = 0;  // largest correction so far [m]
};

std::vector<Candidate> candidatesOf(const DoublesProblem& problem)
{
  constexpr double kHopeless = -15;  // [log-odds]: no other pair makes up for it
  const Conditioned unconditioned(problem);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < problem.objects.size(); ++i)
    for (std::size_t j = i + 1; j < problem.objects.size(); ++j)
    {
      if (problem.distinct.count({i, j})) continue;
      Candidate c;
      c.pair = {i, j};
      c.prior = labelLogOdds(
                    problem.objects[i].labelCounts, problem.objects[j].labelCounts, problem.beta,
                    problem.labels) -
                std::log(problem.density);
      c.gain = unconditioned.gain(c);
      if (c.gain > kHopeless) candidates.push_back(c);
    }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return candidates;
}

bool shareAnObject(const Pair& a, const Pair& b)
{
  return a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
}

Doubles grownFrom(
    const Candidate& first, const std::vector<Candidate>& candidates, const DoublesProblem& problem)
{
  Doubles result;
  Conditioned state(problem);
  std::vector<const Candidate*> open;
  for (const auto& c : candidates) open.push_back(&c);
  const Candidate* next = &first;
  double gain = state.gain(first);
  while (next)
  {
    result.pairs.push_back(next->pair);
    result.logOdds += gain;
    result.misfit += state.misfit(next->pair);
    state.join(next->pair);
    open.erase(
        std::remove_if(
            open.begin(), open.end(),
            [&](const Candidate* c) { return shareAnObject(c->pair, next->pair); }),
        open.end());
    next = nullptr;
    gain = kMinGain;
    for (const Candidate* c : open)
      if (const double g = state.gain(*c); g > gain)
      {
        gain = g;
        next = c;
      }
  }
  std::sort(result.pairs.begin(), result.pairs.end());
  return result;
}

/** Whether `other` pairs an object differently than `best` does, and the two cannot both be true.
 * An object that was mapped three times makes three pairs, which do not contradict each other. */
bool contradicts(
    const Doubles& other,
    const Doubles& best,
    const std::vector<Candidate>& candidates,
    const Conditioned& withBest)
{
  const auto isPossible = [&](const Pair& pair)
  {
    const auto candidate = std::find_if(
        candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.pair == pair; });
    return candidate != candidates.end() && withBest.gain(*candidate) > 0;
  };
  for (const Pair& p : other.pairs)
    for (const Pair& q : best.pairs)
      if (p != q && shareAnObject(p, q) && !isPossible(p)) return true;
  return false;
}

}  // namespace

double labelLogOdds(
    const std::map<std::string, unsigned>& a,
    const std::map<std::string, unsigned>& b,
    double beta,
    unsigned labels)
{
  auto both = a;
  for (const auto& [label, n] : b) both[label] += n;
  return logDirichletMultinomial(both, beta, labels) - logDirichletMultinomial(a, beta, labels) -
         logDirichletMultinomial(b, beta, labels);
}

Doubles bestDoubles(const DoublesProblem& problem)
{
  Doubles best;
  if (problem.objects.size() < 2) return best;
  const auto candidates = candidatesOf(problem);
  std::vector<Doubles> all;
  for (std::size_t s = 0; s < std::min(kMaxFirstPairs, candidates.size()); ++s)
    all.push_back(grownFrom(candidates[s], candidates, problem));
  for (const auto& c : all)
    if (c.logOdds > best.logOdds) best = c;
  Conditioned withBest(problem);
  for (const Pair& pair : best.pairs) withBest.join(pair);
  for (const auto& c : all)
    if (contradicts(c, best, candidates, withBest))
      best.logOddsSecond = std::max(best.logOddsSecond, c.logOdds);
  return best;
}

}  // namespace quadmap
