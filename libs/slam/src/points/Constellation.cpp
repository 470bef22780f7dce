#include "quadmap/slam/points/Constellation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/maps/Association.h"

namespace quadmap
{
namespace
{
using Pair = std::pair<std::size_t, std::size_t>;

constexpr std::size_t kMaxSeeds = 30;  // first pairs that are tried, the likeliest first
constexpr double kMinGain = 1.0;       // of one more pair [ln odds]
/** Positions are linear in each other only for small turns: of a correction this share is unsure.
 */
constexpr double kNonlinearity = 0.05;

/** log of the probability of label counts, for one order of them. */
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
  double prior = 0;  //!< Label odds minus ln density
  double gain = 0;   //!< With the unconditioned covariance
};

/** Positions and their covariance, given some pairs are one object each. */
class Conditioned
{
 public:
  explicit Conditioned(const ConstellationProblem& problem) :
      P_(problem.covariance), floor_(problem.floorSigma)
  {
    dimension_ = problem.objects.front().position.size();
    x_.resize(P_.rows());
    for (std::size_t i = 0; i < problem.objects.size(); ++i)
      x_.segment(row(i), dimension_) = problem.objects[i].position;
  }

  double gain(const Candidate& c) const
  {
    return logGaussian(difference(c.pair), covariance(c.pair)) + c.prior;
  }

  double misfit(const Pair& pair) const
  {
    const Eigen::VectorXd d = difference(pair);
    return 0.5 * d.dot(covariance(pair).llt().solve(d));
  }

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
  Eigen::MatrixXd covariance(const Pair& p) const
  {
    const auto block = [&](std::size_t i, std::size_t j)
    { return P_.block(row(i), row(j), dimension_, dimension_); };
    const double sigma = std::hypot(floor_, kNonlinearity * correction_);
    return block(p.first, p.first) + block(p.second, p.second) - block(p.first, p.second) -
           block(p.second, p.first) +
           sigma * sigma * Eigen::MatrixXd::Identity(dimension_, dimension_);
  }

  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
  Eigen::Index dimension_ = 0;
  double floor_ = 0, correction_ = 0;
};

std::vector<Candidate> candidatesOf(const ConstellationProblem& problem)
{
  constexpr double kHopeless = -15;  // [ln odds]: no other pair makes up for it
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

Constellation grownFrom(
    const Candidate& seed,
    const std::vector<Candidate>& candidates,
    const ConstellationProblem& problem)
{
  Constellation result;
  Conditioned state(problem);
  std::vector<const Candidate*> open;
  for (const auto& c : candidates) open.push_back(&c);
  const Candidate* next = &seed;
  double gain = state.gain(seed);
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

/** Does it take an object for another one than the best does, and cannot be true beside it? Three
 * maps of one object are three pairs that do not contradict each other. */
bool contradicts(
    const Constellation& other,
    const Constellation& best,
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

Constellation bestConstellation(const ConstellationProblem& problem)
{
  Constellation best;
  if (problem.objects.size() < 2) return best;
  const auto candidates = candidatesOf(problem);
  std::vector<Constellation> all;
  for (std::size_t s = 0; s < std::min(kMaxSeeds, candidates.size()); ++s)
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
