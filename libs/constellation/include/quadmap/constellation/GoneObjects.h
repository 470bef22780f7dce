#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "quadmap/constellation/ConstellationMatch.h"
#include "quadmap/estimation/ExistenceLooks.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/Visibility.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** What GoneObjects goes by. All must outlive it. */
struct GoneRules
{
  const LabelTable& labels;
  const ExistenceOptions& existence;
  const MergeOptions& merging;
  const ConstellationOptions& constellation;
};

/** Finds the objects of a map that a session, which was found in it, shows to be no longer where
 * they were: doc/mathematics.md, (19.9), and "Changes" there. */
class GoneObjects
{
 public:
  using Objects = std::vector<const MapObject*>;

  /** \param known Of the map; they must outlive this.
   *  \param local Of the session, in its own frame. \param match Where they are in the map. */
  GoneObjects(
      const Objects& known,
      const Objects& local,
      const ConstellationMatch& match,
      const GoneRules& rules);

  /** Takes what one frame of the session shows where the known objects are.
   * \param T_map_robot In the frame of the map.
   * \param objectOfBox The session's objects that its boxes were taken for, by their index. */
  void look(
      const CObservationObjects& boxes,
      const mrpt::poses::CPose3D& T_map_robot,
      const std::map<std::size_t, ObjectId>& objectOfBox);

  std::set<ObjectId> gone() const;

 private:
  bool hasShifted(const MapObject& object) const;
  bool isShown(
      const MapObject& object,
      const CObservationObjects& boxes,
      const FrameGeometry& frame,
      const std::map<std::size_t, ObjectId>& objectOfBox) const;
  bool mayBe(ObjectId localId, const MapObject& object) const;

  GoneRules rules_;
  Objects missing_;                           //!< Of the map's objects, those without a partner
  std::map<ObjectId, ObjectId> partnerOf_;    //!< Of the session's objects
  std::map<ObjectId, MapObject> local_;       //!< The session's objects, in the map's frame
  std::map<ObjectId, ExistenceLooks> looks_;  //!< At the missing ones
};

}  // namespace quadmap
