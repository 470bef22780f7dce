#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "merging/JointAlignment.h"
#include "merging/MergedMap.h"
#include "quadmap/constellation/GoneObjects.h"
#include "quadmap/maps/MapMerge.h"

namespace quadmap
{
using IdPairs = std::vector<std::pair<ObjectId, ObjectId>>;  //!< (own, other)

/** Two maps of one place, and which of their objects are the same. */
struct PairedMaps
{
  ConstellationMatch match;  //!< Local: the other map. The place is that of the joint estimate
  JointEstimate joint;
  IdPairs together;   //!< The objects of the joint estimate, in its order
  IdPairs displaced;  //!< The same things, but not in the same place: no part of the estimate
};

/** What the two maps have of one object together: counts, labels, times, existence. Its state is
 * that of `own`. */
MapObject pooled(const MapObject& own, const MapObject& other, const ExistenceOptions& existence);

/** \return Nothing when it cannot be told where the other map is. */
std::optional<PairedMaps> pairMaps(
    const MergedMap& own,
    const MergedMap& other,
    const GoneRules& rules,
    const EstimatorOptions& estimator,
    const MapMergeOptions& options);

}  // namespace quadmap
