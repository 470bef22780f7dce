#include "merging/MergePlan.h"

#include <algorithm>
#include <set>

#include "merging/MergeSide.h"
#include "merging/PairedMaps.h"
#include "quadmap/constellation/Moves.h"
#include "quadmap/estimation/ObjectRules.h"

namespace quadmap
{
namespace
{
class Planner
{
 public:
  Planner(
      const MergedMap& own,
      const MergedMap& other,
      const PairedMaps& both,
      const GoneRules& rules,
      const MapMergeOptions& options) :
      own_(own),
      other_(other),
      both_(both),
      rules_(rules),
      options_(options),
      shift_(both.joint.T_own_other)
  {
    plan_.report.match = both.match;
    plan_.report.placeCovariance = both.joint.covariance;
    plan_.report.otherIsNewer = other.age() >= own.age();
  }

  MergePlan run(const MatchedFrames& ownFrames, const MatchedFrames& otherFrames)
  {
    joinTogether();
    moveDisplaced();
    findConflicts(ownFrames, otherFrames);
    settleDoubts();
    addOther();
    return std::move(plan_);
  }

 private:
  bool otherIsNewer() const { return plan_.report.otherIsNewer; }

  void joinTogether()
  {
    for (std::size_t i = 0; i < both_.together.size(); ++i)
    {
      const auto& [here, there] = both_.together[i];
      const JointEstimate::Object& joint = both_.joint.objects[i];
      PlannedObject planned;
      planned.origin = {here, here, there};
      planned.object = pooled(own_.at(here).object, other_.at(there).object, rules_.existence);
      planned.object.object = ellipsoidOf(joint.state);
      planned.known = joint.known;
      planned.sharedError = joint.sharedError;
      add(planned);
    }
  }

  /** What was moved a little is where the newer map has it. */
  void moveDisplaced()
  {
    for (const auto& [here, there] : both_.displaced)
    {
      const MergedMap::Object &a = own_.at(here), &b = other_.at(there);
      PlannedObject planned = inOwnFrame(b);
      const double way = (planned.object.object.center() - a.object.object.center()).norm();
      const Ellipsoid newer = (otherIsNewer() ? planned.object : a.object).object;
      planned.origin = {here, here, there};
      planned.object = pooled(a.object, b.object, rules_.existence);
      planned.object.object = newer;
      if (!otherIsNewer())
      {
        planned.known = a.known;
        planned.sharedError.setZero();
      }
      add(planned);
      note({MapConflict::Moved, planned.origin, planned.object.label(), way});
    }
  }

  PlannedObject inOwnFrame(const MergedMap::Object& b) const
  {
    PlannedObject planned;
    const UprightState y = uprightStateOf(b.object.object);
    planned.object = b.object;
    planned.object.object = ellipsoidOf(shift_.state(y));
    planned.known = shift_.information(b.known);
    const auto J = byShiftAndYaw(shift_, y);
    planned.sharedError = J * both_.joint.covariance * J.transpose();
    return planned;
  }

  void add(const PlannedObject& planned)
  {
    plan_.changed.push_back(planned);
    if (planned.origin.other) settled_.insert(*planned.origin.other);
  }

  void note(const MapMerge::Conflict& conflict) { plan_.report.conflicts.push_back(conflict); }

  MapMerge::Origin originOf(const MergeSide& side, ObjectId id) const
  {
    MapMerge::Origin origin;
    (side.isOwn ? origin.own : origin.other) = id;
    if (side.isOwn) origin.id = id;
    return origin;
  }

  /** Objects that only `known` has and the frames of `session` show not to be there. */
  std::set<ObjectId> absent(const MergeSide& known, const MergeSide& session) const
  {
    ConstellationMatch match;  // both are in the own frame
    for (const auto* pairs : {&both_.together, &both_.displaced})
      for (const auto& [here, there] : *pairs)
        match.pairs.emplace_back(session.isOwn ? here : there, session.isOwn ? there : here);
    GoneObjects objects(known.confirmed, session.confirmed, match, rules_);
    if (*session.frames)
      (*session.frames)(
          [&](const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot,
              const std::map<std::size_t, ObjectId>& objectOfBox)
          { objects.look(boxes, session.T_own_map + T_map_robot, objectOfBox); });
    return objects.gone();
  }

  void findConflicts(const MatchedFrames& ownFrames, const MatchedFrames& otherFrames)
  {
    std::set<ObjectId> ownPaired, otherPaired;
    for (const auto* pairs : {&both_.together, &both_.displaced})
      for (const auto& [here, there] : *pairs)
      {
        ownPaired.insert(here);
        otherPaired.insert(there);
      }
    MergeSide own = sideOf(own_, ownPaired, {}, ownFrames);
    own.isOwn = true;
    const MergeSide other = sideOf(other_, otherPaired, both_.match.T_map_local, otherFrames);
    judge(otherIsNewer() ? own : other, otherIsNewer() ? other : own);
  }

  void judge(const MergeSide& older, const MergeSide& newer)
  {
    const std::set<ObjectId> gone = absent(older, newer), fresh = absent(newer, older);
    std::vector<const MapObject*> left;
    for (const MapObject* object : older.unpaired)
      if (gone.count(object->id) != 0) left.push_back(object);
    std::set<ObjectId> from, to;
    for (const Move& move : movesBetween(left, newer.unpaired, rules_.labels, options_))
    {
      from.insert(move.from);
      to.insert(move.to);
      MapMerge::Origin origin = originOf(newer, move.to);
      (older.isOwn ? origin.own : origin.other) = move.from;
      note({MapConflict::Moved, origin, labelOf(newer, move.to), move.distance});
      drop(older, move.from);
    }
    const MapRegion oldRegion(older.confirmed), newRegion(newer.confirmed);
    for (const MapObject* object : older.unpaired)
    {
      if (from.count(object->id) != 0) continue;
      if (gone.count(object->id) != 0)
      {
        MapMerge::Origin origin = originOf(older, object->id);
        origin.id = 0;
        note({MapConflict::Gone, origin, object->label(), 0});
        drop(older, object->id);
      }
      else if (newRegion.contains(object->object.center().head<2>()))
        note({MapConflict::OnlyOne, originOf(older, object->id), object->label(), 0});
    }
    for (const MapObject* object : newer.unpaired)
    {
      if (to.count(object->id) != 0) continue;
      if (fresh.count(object->id) != 0)
        note({MapConflict::New, originOf(newer, object->id), object->label(), 0});
      else if (oldRegion.contains(object->object.center().head<2>()))
        note({MapConflict::OnlyOne, originOf(newer, object->id), object->label(), 0});
    }
  }

  static std::string labelOf(const MergeSide& side, ObjectId id)
  {
    for (const MapObject* object : side.confirmed)
      if (object->id == id) return object->label();
    return {};
  }

  void drop(const MergeSide& side, ObjectId id)
  {
    if (side.isOwn)
      plan_.removed.push_back(id);
    else
      settled_.insert(id);
  }

  /** Of what neither map is sure of, the newer one's word stands: maps of one place make the same
   * mistakes, so that two doubts do not make an object. */
  void settleDoubts()
  {
    std::set<ObjectId> ownPaired;
    for (const auto& [here, there] : both_.together) ownPaired.insert(here);
    for (const MergedMap::Object& a : own_.objects)
    {
      if (a.object.confirmed || ownPaired.count(a.object.id) != 0) continue;
      for (const MergedMap::Object& b : other_.objects)
      {
        if (b.object.confirmed || settled_.count(b.object.id) != 0) continue;
        if (!areOneObject(a.object, inOwnFrame(b).object, rules_.labels, rules_.merging)) continue;
        if (!otherIsNewer())
          settled_.insert(b.object.id);
        else
        {
          plan_.removed.push_back(a.object.id);
          break;
        }
      }
    }
  }

  /** Takes over what only the other map has. */
  void addOther()
  {
    for (const MergedMap::Object& o : other_.objects)
    {
      if (settled_.count(o.object.id) != 0) continue;
      PlannedObject planned = inOwnFrame(o);
      planned.origin.other = o.object.id;
      add(planned);
    }
  }

  const MergedMap &own_, &other_;
  const PairedMaps& both_;
  const GoneRules& rules_;
  const MapMergeOptions& options_;
  StateShift shift_;
  std::set<ObjectId> settled_;  //!< Objects of the other map that need nothing more
  MergePlan plan_;
};

}  // namespace

std::optional<MergePlan> planMerge(
    const MergedMap& own,
    const MergedMap& other,
    const MatchedFrames& ownFrames,
    const MatchedFrames& otherFrames,
    const GoneRules& rules,
    const EstimatorOptions& estimator,
    const MapMergeOptions& options)
{
  const auto both = pairMaps(own, other, rules, estimator, options);
  if (!both) return std::nullopt;
  return Planner(own, other, *both, rules, options).run(ownFrames, otherFrames);
}

}  // namespace quadmap
