#include "GoneObjects.h"

#include <algorithm>
#include <map>

#include "quadmap/estimation/Existence.h"
#include "quadmap/estimation/ExistenceLooks.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/Visibility.h"

namespace quadmap
{
namespace
{
/** How much of a box lies outside the outline does not matter here: an object is only gone when
 * nothing can be it. */
constexpr double kMinInside = 0;

class GoneObjects
{
 public:
  GoneObjects(
      const CQuadricObjectMap& given,
      const SlamResult& run,
      const ConstellationMatch& match,
      const RelocalizationOptions& options) :
      given_(given), run_(run), options_(options), existence_(run.map.insertionOptions.existence)
  {
    for (const auto& [here, there] : match.pairs)
    {
      partnerOf_[here] = there;
      found_.insert(there);
    }
    for (const MapObject* object : run.map.confirmedObjects())
    {
      MapObject& moved = local_.emplace(object->id, *object).first->second;
      moved.object = object->object.transformed(match.T_map_local);
    }
  }

  /** \return What (19.7), doc/mathematics.md, and hasShifted() say is gone. */
  std::set<ObjectId> find(const BackEnd::BoxesOf& boxesOf) const
  {
    std::map<ObjectId, ExistenceLooks> looks;  // at what may still be there
    std::size_t next = 0;                      // decision
    for (std::size_t k = 0; k < run_.keyframes.size(); ++k)
    {
      std::map<std::size_t, ObjectId> objectOfBox;
      for (; next < run_.decisions.size() && run_.decisions[next].keyframe == k; ++next)
        if (const auto& d = run_.decisions[next].decision; d.object) objectOfBox[d.box] = *d.object;
      const auto boxes = boxesOf(k);
      if (!boxes) continue;
      const FrameGeometry frame{
          pinholeFrom(boxes->cameraParams), run_.keyframes[k].T_map_robot + boxes->sensorPose,
          &boxes->coarseDepth};
      const auto& camera = frame.T_map_sensor;
      for (const MapObject* object : given_.confirmedObjects())
        if (found_.count(object->id) == 0 && shouldBeVisible(object->object, frame, existence_))
          looks[object->id].add(
              {
                  {camera.x(), camera.y(), camera.z()},
                  mrpt::Clock::toDouble(boxes->timestamp),
                  isShown(*object, *boxes, frame, objectOfBox)
          },
              object->object.center(), existence_);
    }
    std::set<ObjectId> gone;
    for (const MapObject* object : given_.confirmedObjects())
    {
      if (found_.count(object->id) != 0) continue;
      const double logOdds = looks[object->id].logOdds(existence_.detectionProbability, existence_);
      if (hasShifted(*object) || logOdds < -options_.minLogOdds) gone.insert(object->id);
    }
    return gone;
  }

 private:
  /** True when something like it is so near that both cannot stand there, and yet is not it. */
  bool hasShifted(const MapObject& object) const
  {
    const auto& merging = run_.map.insertionOptions.merging;
    return std::any_of(
        local_.begin(), local_.end(),
        [&](const auto& other)
        {
          return partnerOf_.count(other.first) == 0 &&
                 areAlike(other.second, object, run_.map.labels(), options_) &&
                 areOneObject(other.second, object, run_.map.labels(), merging);
        });
  }

  /** True when a box where the object should be may show it and shows nothing else that is known.
   */
  bool isShown(
      const MapObject& object,
      const CObservationObjects& boxes,
      const FrameGeometry& frame,
      const std::map<std::size_t, ObjectId>& objectOfBox) const
  {
    const LabelTable& labels = run_.map.labels();
    const auto outline = outlineInImage(object, frame, labels);
    if (!outline) return false;
    ShownRule rule;
    rule.minInside = kMinInside;
    rule.minLabelAgreement = options_.minLabelAgreement;
    for (std::size_t b = 0; b < boxes.objects.size(); ++b)
    {
      const auto& box = boxes.objects[b];
      if (!mayShow(box.box, labels.canonical(box.label), object, *outline, labels, rule)) continue;
      const auto owner = objectOfBox.find(b);
      if (owner == objectOfBox.end() || mayBe(owner->second, object)) return true;
    }
    return false;
  }

  /** True when one of the run's objects is at the place of this one, or not sure enough to be
   * elsewhere. */
  bool mayBe(ObjectId localId, const MapObject& object) const
  {
    const auto local = local_.find(localId);
    if (local == local_.end()) return true;
    return partnerOf_.count(localId) == 0 &&
           areOneObject(
               local->second, object, run_.map.labels(), run_.map.insertionOptions.merging);
  }

  const CQuadricObjectMap& given_;
  const SlamResult& run_;
  const RelocalizationOptions& options_;
  const ExistenceOptions& existence_;
  std::map<ObjectId, ObjectId> partnerOf_;  //!< Of the run's objects
  std::set<ObjectId> found_;                //!< Of the map's
  std::map<ObjectId, MapObject> local_;     //!< The run's confirmed objects, in the map's frame
};

}  // namespace

std::set<ObjectId> goneObjects(
    const CQuadricObjectMap& given,
    const SlamResult& run,
    const ConstellationMatch& match,
    const BackEnd::BoxesOf& boxesOf,
    const RelocalizationOptions& options)
{
  return GoneObjects(given, run, match, options).find(boxesOf);
}

}  // namespace quadmap
