#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "quadmap/constellation/Doubles.h"

namespace quadmap::doubles
{
/** Two objects that may be one thing. */
struct Candidate
{
  const SightedObject *before = nullptr, *again = nullptr;
  double logDensity = 0;  //!< Of things with this label [ln 1/m^2]

  Eigen::Vector3d gap() const
  {
    return comparedPoint(*again->object) - comparedPoint(*before->object);
  }
  Drift::Moved moved() const
  {
    return {comparedPoint(*again->object), before->nearest, again->nearest};
  }
  bool isSame(const Candidate& other) const
  {
    return before == other.before && again == other.again;
  }
  bool shares(const Candidate& other) const
  {
    return before == other.before || again == other.again || before == other.again ||
           again == other.before;
  }
};

/** Candidates that are taken for true together. */
struct DoublesHypothesis
{
  std::vector<Candidate> pairs;
  double logOdds = 0;
  double distance2 = 0;  //!< Squared Mahalanobis distance of all gaps together

  bool shares(const Candidate& candidate) const
  {
    return std::any_of(
        pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.shares(candidate); });
  }
  bool has(const Candidate& candidate) const
  {
    return std::any_of(
        pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.isSame(candidate); });
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
