#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "merging/MergedMap.h"
#include "quadmap/constellation/GoneObjects.h"
#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/maps/MapMerge.h"

namespace quadmap
{
/** An object that the merged map gets, or estimates anew. */
struct PlannedObject
{
  MapMerge::Origin origin;  //!< Its `id` is 0 when the own map has not got it
  MapObject object;         //!< In the own map's frame; its covariance is not looked at
  InformationPrior known;
  UprightCovariance sharedError = UprightCovariance::Zero();
};

struct MergePlan
{
  MapMerge report;                     //!< Objects that come have no ids of the merged map yet
  std::vector<PlannedObject> changed;  //!< In the order of their ids in the maps, own ones first
  std::vector<ObjectId> removed;       //!< Own objects that go
};

/** Calls its argument with the frames of a session, and for each box the object it was taken for.
 */
using MatchedFrames =
    std::function<void(const std::function<void(
                           const CObservationObjects&,
                           const mrpt::poses::CPose3D& T_map_robot,
                           const std::map<std::size_t, ObjectId>& objectOfBox)>&)>;

/** Decides how another map becomes part of the own one.
 * \param ownFrames,otherFrames Empty when nobody has them.
 * \return Nothing when it cannot be told where the other map is. */
std::optional<MergePlan> planMerge(
    const MergedMap& own,
    const MergedMap& other,
    const MatchedFrames& ownFrames,
    const MatchedFrames& otherFrames,
    const GoneRules& rules,
    const EstimatorOptions& estimator,
    const MapMergeOptions& options);

}  // namespace quadmap
