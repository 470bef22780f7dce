#pragma once

#include <Eigen/Dense>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace quadmap
{
/** Objects of one run, some of which may be doubles: one thing that was mapped twice because the
 * robot had drifted in between. */
struct DoublesProblem
{
  struct Object
  {
    Eigen::VectorXd position;  //!< 2 or 3 numbers [m]
    std::map<std::string, unsigned> labelCounts;
  };

  std::vector<Object> objects;
  Eigen::MatrixXd covariance;  //!< Joint covariance of all positions [m^2]
  /** Pairs (smaller index first) that are certainly two objects. */
  std::set<std::pair<std::size_t, std::size_t>> distinct;

  double density = 0.1;      //!< Objects per volume of the world [1/m^D], > 0
  double beta = 0.1;         //!< Dirichlet prior of the label histograms, > 0
  unsigned labels = 5;       //!< Number of labels
  double leastSigma = 0.03;  //!< Least standard deviation of a difference of positions [m]
};

/** A set of pairs, each of which is one object that was mapped twice. */
struct Doubles
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  //!< Smaller index first
  /** Log-odds of "each pair is one object" against "each pair is two objects", from normalised
   * densities of the positions and from the labels. */
  double logOdds = 0;
  /** M, half the sum of the squared distances between the objects of each pair [variances]. */
  double misfit = 0;
  /** Log-odds of the best set that contradicts this one; 0 when no set does. */
  double logOddsSecond = 0;
};

/** The most likely set of doubles: doc/mathematics.md, section 18. Each likely pair is tried as the
 * first one. Joining it moves all objects by their joint covariance. The pairs that then lie on
 * each other are added, the best one first. A single pair may fit by chance; several pairs that fit
 * at once rarely do. */
Doubles bestDoubles(const DoublesProblem& problem);

/** ln( P(labels of both | one object) / P(labels of both | two objects) ). Each object draws its
 * labels from a distribution of its own, which is Dirichlet(beta): doc/mathematics.md, (18.6). */
double labelLogOdds(
    const std::map<std::string, unsigned>& a,
    const std::map<std::string, unsigned>& b,
    double beta,
    unsigned labels);

}  // namespace quadmap
