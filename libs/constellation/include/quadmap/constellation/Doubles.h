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

/** Finds those objects of a run that are most certainly one thing each, as far as the drift of the
 * poses explains where they are: doc/mathematics.md, "Loops". Nothing when there are none, or when
 * they could as well be others. Deterministic.
 * \param sighted All that count, each once.
 * \param shouldStop Asked often; after a yes nothing is found. */
std::optional<Doubles> findDoubles(
    const std::vector<SightedObject>& sighted,
    const Drift& drift,
    const LabelTable& labels,
    const ConstellationOptions& options,
    const std::function<bool()>& shouldStop);

}  // namespace quadmap
