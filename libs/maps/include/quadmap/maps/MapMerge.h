#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/constellation/ConstellationMatch.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** How two maps of one place become one. Section [merging]. */
struct MapMergeOptions : public ConstellationOptions
{
  /** How far an object that stayed may seem to have moved between the maps, beyond the uncertainty
   * of both [m], > 0: sides that only one of them saw. */
  double staySigma = 0.02;
  /** Correlation of what the two maps err by about an object, in [0, 1]: both see the same sides of
   * it with the same perception. 0 takes the maps as independent. */
  double errorCorrelation = 0.75;

 private:
  void describe(OptionList& list) override;
};

/** The frames that a map was made of. Calls its argument with the boxes of each and T_map_robot; an
 * empty function when nobody has them. */
using SessionFrames = std::function<void(
    const std::function<void(const CObservationObjects&, const mrpt::poses::CPose3D&)>&)>;

/** What is different in two maps of one place. */
enum class MapConflict
{
  Moved,  //!< The newer map has it somewhere else
  Gone,   //!< Only the older one has it, and the frames of the newer one show that it is not there
  New,    //!< Only the newer one has it, and the frames of the older one show that it was not there
  /** Only one has it, though the other one knows things around it. It stays, as no frames tell. */
  OnlyOne
};
std::string nameOf(MapConflict kind);  //!< moved, gone, new, only one

/** How another map was merged into one: CQuadricObjectMap::mergeMap(). */
struct MapMerge
{
  /** Where an object of the merged map comes from. */
  struct Origin
  {
    ObjectId id = 0;                     //!< In the merged map; 0: it is not there
    std::optional<ObjectId> own, other;  //!< In the two maps
  };
  struct Conflict
  {
    MapConflict kind = MapConflict::OnlyOne;
    Origin origin;
    std::string label;
    double distance = 0;  //!< Moved: how far [m]
  };

  /** Here `local` is the other map, in the frame it has. The place is that of the joint estimate.
   */
  ConstellationMatch match;
  Eigen::Matrix4d placeCovariance = Eigen::Matrix4d::Zero();  //!< Of (x, y, z [m], yaw [rad])
  bool otherIsNewer = true;         //!< It ends later; of equal ends it has no fewer measurements
  std::vector<Origin> origins;      //!< Of all objects of the merged map, by id
  std::vector<Conflict> conflicts;  //!< Among confirmed objects
};

}  // namespace quadmap
