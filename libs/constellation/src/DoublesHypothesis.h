#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "quadmap/constellation/Doubles.h"

namespace quadmap::doubles
{
using Candidate = DoublesCandidate;

inline bool areSame(const Candidate& a, const Candidate& b)
{
  return a.before == b.before && a.again == b.again;
}

inline bool haveCommon(const Candidate& a, const Candidate& b)
{
  return a.before == b.before || a.again == b.again || a.before == b.again || a.again == b.before;
}

/** Candidates that are taken for true together. */
struct DoublesHypothesis
{
  std::vector<Candidate> pairs;
  double logOdds = 0;
  double distance2 = 0;  //!< Squared Mahalanobis distance of all gaps together

  bool shares(const Candidate& candidate) const
  {
    return std::any_of(
        pairs.begin(), pairs.end(), [&](const auto& pair) { return haveCommon(pair, candidate); });
  }
  bool has(const Candidate& candidate) const
  {
    return std::any_of(
        pairs.begin(), pairs.end(), [&](const auto& pair) { return areSame(pair, candidate); });
  }
  /** Takes a thing of the other one for something else. */
  bool contradicts(const DoublesHypothesis& other) const
  {
    return std::any_of(
        pairs.begin(), pairs.end(),
        [&](const auto& pair) { return other.shares(pair) && !other.has(pair); });
  }
};

}  // namespace quadmap::doubles
