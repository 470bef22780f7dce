#pragma once

#include <Eigen/Dense>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace quadmap
{
/** What is known of objects some of which may be the same one, mapped twice by a robot that had
 * drifted in between. */
struct ConstellationProblem
{
  struct Object
  {
    Eigen::VectorXd position;  //!< [m], 2 or 3 numbers
    std::map<std::string, unsigned> labelCounts;
  };

  std::vector<Object> objects;
  Eigen::MatrixXd covariance;  //!< Of all positions, jointly [m^2]
  /** Pairs (smaller index first) that are two objects for sure. */
  std::set<std::pair<std::size_t, std::size_t>> distinct;

  double density = 0.1;      //!< Of objects in the world [1/m^D], > 0
  double beta = 0.1;         //!< Dirichlet prior of the label histograms, > 0
  unsigned labels = 5;       //!< Number of classes
  double floorSigma = 0.03;  //!< Least uncertainty of a difference [m]
};

/** Pairs of objects that are one object each. */
struct Constellation
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  //!< Smaller index first
  /** ln of how much more likely it is that the pairs are one object each than that they are two,
   * with the positions' normalised densities. */
  double logOdds = 0;
  /** Half the sum of the squared distances that are taken away, in their standard deviations. */
  double misfit = 0;
  double logOddsSecond = 0;  //!< Of the best constellation that contradicts it, or of none: 0
};

/** The most likely constellation: each pair is tried as the first one; what it would move moves
 * (by the joint covariance), and the pairs that then lie on each other are added, the best first.
 * One pair alone may be chance; that several fit at once rarely is. */
Constellation bestConstellation(const ConstellationProblem& problem);

/** ln of P(labels of both | one object) / P(labels | two objects), each object's labels being drawn
 * from its own distribution, which is Dirichlet(beta). */
double labelLogOdds(
    const std::map<std::string, unsigned>& a,
    const std::map<std::string, unsigned>& b,
    double beta,
    unsigned labels);

}  // namespace quadmap
