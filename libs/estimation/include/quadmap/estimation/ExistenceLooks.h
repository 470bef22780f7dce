#pragma once

#include <Eigen/Dense>
#include <deque>
#include <optional>

#include "quadmap/estimation/Visibility.h"

namespace quadmap
{
/** Numbers of independent looks that saw an object and that did not. */
struct LookCounts
{
  double seen = 0, missed = 0;

  LookCounts& operator+=(const LookCounts& other)
  {
    seen += other.seen;
    missed += other.missed;
    return *this;
  }
  LookCounts& operator-=(const LookCounts& other)
  {
    seen -= other.seen;
    missed -= other.missed;
    return *this;
  }
};

/** Probability p_D that a look sees an object, (13.3) of doc/mathematics.md: the counts on top of a
 * prior that weighs as much as `existence.detectionPriorWeight` looks. */
double detectionProbability(
    const LookCounts& counts, double priorMean, const ExistenceOptions& existence);

/** All looks at one object: the frames that showed it, and those that should have. Looks from one
 * place at one time make the same mistakes, whether they see the object or not. They are kept as
 * one visit, and visits near each other share what they know: doc/mathematics.md, (13.1). */
class ExistenceLooks
{
 public:
  struct Look
  {
    Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Where from, in the map [m]
    double time = 0;                                   //!< [s]
    bool seen = false;
    double boxSize = 0;  //!< Smaller side of the box that showed it; 0 of a miss [px]
  };

  ExistenceLooks() = default;
  /** Starts from log-odds that earlier looks led to. Those looks are no longer known. */
  explicit ExistenceLooks(double logOdds) : before_{logOdds, {}, {}, {}, {}} {}

  /** \param center Of the object [m]. */
  void add(const Look& look, const Eigen::Vector3d& center, const ExistenceOptions& options);

  LookCounts independent(const ExistenceOptions& options) const;

  /** What the looks say from the first return on: nobody had looked at the object for
   * independentViewTime, and it was known before, its log-odds being above confirmLogOdds. Nothing
   * when nobody returned to it. \return What they add to the log-odds (13.2), without bounds. */
  std::optional<double> afterReturn(double labelProbability, const ExistenceOptions& options) const;

  /** Harmonic mean of the box sizes, as sizes go with one over the distance [px]; nothing before it
   * was seen. Where it is larger a detector can find it, however small that is. */
  std::optional<double> usualSize() const;

  /** Log-odds that the object exists, (13.2). \param labelProbability p_D of its label. */
  double logOdds(double labelProbability, const ExistenceOptions& options) const;

 private:
  struct Visit
  {
    Eigen::Vector3d camera = Eigen::Vector3d::Zero();
    double reach = 0;            // beyond it a camera's mistakes are others [m]
    double first = 0, last = 0;  // times [s]
    unsigned seen = 0, missed = 0;
    double crowd = 0;  // sum of the correlations with all looks, its own included

    unsigned looks() const { return seen + missed; }
  };
  struct Known
  {
    double logOdds = 0;
    LookCounts counts;
    LookCounts recent;                  // of these, as many as tell its own p_D
    std::optional<double> last;         // time of the last of them [s]
    std::optional<double> afterReturn;  // log-odds
  };

  static double correlation(const Visit& of, const Visit& with, const ExistenceOptions& options);
  static LookCounts independent(const Visit& visit, const ExistenceOptions& options);
  Known known(double labelProbability, const ExistenceOptions& options) const;
  static void take(
      const Visit& visit, double labelProbability, const ExistenceOptions& options, Known& known);

  std::deque<Visit> visits_;      // in the order of their beginning
  Known before_;                  // of visits that are not kept any more
  double sumOfInverseSizes_ = 0;  // of the boxes that showed it [1/px]
  unsigned boxes_ = 0;
};

}  // namespace quadmap
