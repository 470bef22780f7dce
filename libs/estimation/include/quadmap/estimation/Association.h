#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** Parameters of the Dirichlet process (doc/mathematics.md; Mu et al., IROS 2016). */
struct AssociationParameters
{
  double alpha = 0.5;    //!< Concentration of the Dirichlet process, > 0
  double beta = 0.1;     //!< Dirichlet prior of the label histogram, > 0
  unsigned labels = 80;  //!< U, number of classes
  /** A box joins an object only with at least this posterior probability, in [0, 1): when its
   * likely object is taken by another box of the frame, it is not pressed into an unlikely one. */
  double minJoinPosterior = 0.02;
  double newObjectVolume = 100.0;  //!< V, volume (area in 2-D) a new object may lie in [m^D]
};

/** What the posterior's prior needs to know of an object. */
struct AssociationTarget
{
  unsigned observations = 0;  //!< m_i
  std::vector<std::pair<std::string, unsigned>> labelCounts;
};

struct AssociationCandidate
{
  std::string label;
  bool mayStartObject = true;  //!< False for partial measurements: join or wait
};

struct AssociationDecision
{
  std::size_t measurement = 0;        //!< Index of the box in its frame
  std::optional<std::size_t> target;  //!< Index of the object; nothing: see startsObject
  bool startsObject = false;          //!< True: a new object; false with no target: waits
  double logPosterior = 0;            //!< Normalised over all alternatives, of the one chosen
  double logPosteriorSecond = 0;      //!< Of the best alternative
};

/** Assigns the boxes of one frame: the most probable assignment in which no two boxes share an
 * object (optimal, not greedy).
 * \param logLikelihood ln p(measurement | object): one row per measurement, one column per object.
 * -infinity forbids a pair.
 * \exception std::invalid_argument For parameters that are not positive, a matrix of another size,
 * or a likelihood that is no number. */
std::vector<AssociationDecision> associateFrame(
    const std::vector<AssociationCandidate>& measurements,
    const std::vector<AssociationTarget>& targets,
    const AssociationParameters& parameters,
    const Eigen::MatrixXd& logLikelihood);

/** log N(difference; 0, S), normalised, of any dimension.
 * \exception std::invalid_argument If S is not positive definite. */
double logGaussian(const Eigen::VectorXd& difference, const Eigen::MatrixXd& S);

}  // namespace quadmap
