#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "quadmap/constellation/ConstellationOptions.h"
#include "quadmap/constellation/Drift.h"
#include "quadmap/constellation/SightedObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Things that a map has twice, because the run came back to them without noticing. */
struct Doubles
{
  /** Two objects that are one thing. */
  struct Pair
  {
    ObjectId before = 0, again = 0;
    std::size_t keyframeBefore = 0, keyframeAgain = 0;  //!< Those that saw each from nearest
  };
  std::vector<Pair> pairs;
  double logOdds = 0;   //!< That these are one, against chance
  double distance = 0;  //!< Largest distance between the two of a pair [m]
};

/** The point of an object whose place is compared: the middle of its top [m]. What hides an object
 * hides its bottom, which is then taken to be on the floor. Where the robot has drifted in height,
 * the top is still where it was measured. */
Eigen::Vector3d comparedPoint(const MapObject& object);

/** Two objects of a run that may be one thing. */
struct DoublesCandidate
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
};

/** Among what doubles are looked for, and by what. All must outlive it. */
struct DoublesRules
{
  const std::vector<SightedObject>& sighted;  //!< All that count, each once
  const LabelTable& labels;
  const ConstellationOptions& options;
};

/** Pairs that a drift explains, each for itself: the most likely ones, at most 100, those first. */
std::vector<DoublesCandidate> doublesCandidates(const DoublesRules& rules, const Drift& drift);

/** Finds those objects of a run that are most certainly one thing each, as far as the drift of the
 * poses explains where they are: doc/mathematics.md, "Loops". Nothing when there are none, or when
 * they could as well be others. Deterministic.
 * \param candidates Of this drift or of a larger one. The drift is asked for no others.
 * \param shouldStop Asked often; after a yes nothing is found. */
std::optional<Doubles> findDoubles(
    const DoublesRules& rules,
    const std::vector<DoublesCandidate>& candidates,
    const Drift& drift,
    const std::function<bool()>& shouldStop);

}  // namespace quadmap
