#include "quadmap/maps/CQuadricObjectMap.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/format.h>

#include <ostream>
#include <stdexcept>

#include "quadmap/obs/ConfigCheck.h"

// The base class's name must be visible to the macros.
using mrpt::maps::CMetricMap;
IMPLEMENTS_SERIALIZABLE(CQuadricObjectMap, CMetricMap, quadmap)
// INI files use one of the first two names; MRPT itself looks maps up by the class's full name.
MAP_DEFINITION_REGISTER(
    "CQuadricObjectMap,quadricObjectMap,quadmap::CQuadricObjectMap", quadmap::CQuadricObjectMap)

namespace quadmap
{
void registerMapClasses()
{
  registerObsClasses();
  mrpt::rtti::registerClass(CLASS_ID(CQuadricObjectMap));
}

namespace
{
/** When the library is loaded. With Clang, MRPT_INITIALIZER comes before the class's description.
 */
const struct Registration
{
  Registration() { registerMapClasses(); }
} registration;

}  // namespace

CQuadricObjectMap::CQuadricObjectMap() :
    labels_(std::make_shared<const LabelTable>(LabelTable::installed()))
{
}

// Map definition -----------------------------------------------------------------------------

CQuadricObjectMap::TMapDefinition::TMapDefinition() = default;

void CQuadricObjectMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  const std::string creation = sectionNamePrefix + "_creationOpts";
  rejectUnknownKeys(
      source, creation,
      {"labelTable", "enableSaveAs3DObject", "enableObservationLikelihood",
       "enableObservationInsertion"});
  labelTable = source.read_string(creation, "labelTable", labelTable);
  insertionOpts.loadFromConfigFile(source, sectionNamePrefix + "_insertOpts");
  likelihoodOpts.loadFromConfigFile(source, sectionNamePrefix + "_likelihoodOpts");
  renderOpts.loadFromConfigFile(source, sectionNamePrefix + "_renderOpts");
  perceptionOpts.loadFromConfigFile(source, sectionNamePrefix + "_perceptionOpts");
}

void CQuadricObjectMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  out << "labelTable                   = " << (labelTable.empty() ? "(installed)" : labelTable)
      << "\n";
  insertionOpts.dumpToTextStream(out);
  likelihoodOpts.dumpToTextStream(out);
  renderOpts.dumpToTextStream(out);
  perceptionOpts.dumpToTextStream(out);
}

mrpt::maps::CMetricMap* CQuadricObjectMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& initializer)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(initializer);
  auto map = std::make_unique<CQuadricObjectMap>();
  if (!definition.labelTable.empty()) map->setLabels(LabelTable::fromFile(definition.labelTable));
  map->insertionOptions = definition.insertionOpts;
  map->likelihoodOptions = definition.likelihoodOpts;
  map->renderOptions = definition.renderOpts;
  map->perceptionOptions = definition.perceptionOpts;
  return map.release();
}

// State --------------------------------------------------------------------------------------

void CQuadricObjectMap::setLabels(LabelTable labels)
{
  labels_ = std::make_shared<const LabelTable>(std::move(labels));
}

const CQuadricObjectMap::Objects& CQuadricObjectMap::objects() const { return objects_; }

const std::vector<CQuadricObjectMap::Decision>& CQuadricObjectMap::lastDecisions() const
{
  return lastDecisions_;
}

bool CQuadricObjectMap::isEmpty() const { return objects_.empty(); }

void CQuadricObjectMap::internal_clear()
{
  objects_.clear();
  estimators_.clear();
  estimatedFrom_.clear();
  nextId_ = 1;
  waiting_.clear();
  pairing_.clear();
  room_ = RoomPlanes();
  objectOfInstance_.clear();
  lastDecisions_.clear();
  unknownLabels_.clear();
}

MapObject& CQuadricObjectMap::require(ObjectId id)
{
  const auto it = objects_.find(id);
  if (it == objects_.end()) throw std::out_of_range(mrpt::format("the map has no object %u", id));
  return it->second;
}

// Editing ------------------------------------------------------------------------------------

ObjectId CQuadricObjectMap::addObject(const MapObject& estimated)
{
  constexpr double kMaxTilt = 1e-4;  // [rad]: rounding
  if (estimated.object.rotation().col(2).head<2>().norm() > kMaxTilt)
    throw std::invalid_argument("the objects of the map stand upright, this one is tilted");
  if (estimated.covariance.llt().info() != Eigen::Success)
    throw std::invalid_argument("the covariance of an object must be positive definite");
  if (estimated.labelCounts.empty() || estimated.observations() == 0)
    throw std::invalid_argument("an object of the map needs observations and their labels");

  MapObject object = estimated;
  object.id = nextId_++;
  object.object = ellipsoidOf(uprightStateOf(estimated.object));
  object.confirmed = isConfirmed(object);
  estimators_[object.id] = ObjectEstimator::fromEstimate(
      {uprightStateOf(object.object), object.covariance, 0, object.orientationDefined},
      labels_->properties(object.label()), insertionOptions.estimator);
  objects_[object.id] = object;
  return object.id;
}

void CQuadricObjectMap::merge(ObjectId kept, ObjectId absorbed)
{
  MapObject& a = require(kept);
  const MapObject b = require(absorbed);
  if (kept == absorbed)
    throw std::out_of_range(mrpt::format("object %u cannot be merged with itself", kept));

  estimators_.at(kept).absorb(
      estimators_.at(absorbed), uprightStateOf(a.object), uprightStateOf(b.object));
  for (const auto& [label, count] : b.labelCounts) a.labelCounts[label] += count;
  a.completeCount += b.completeCount;
  a.partialCount += b.partialCount;
  a.missCount = std::min(a.missCount, b.missCount);
  a.existenceLogOdds = std::max(a.existenceLogOdds, b.existenceLogOdds);
  a.firstSeen = std::min(a.firstSeen, b.firstSeen);
  a.lastSeen = std::max(a.lastSeen, b.lastSeen);
  for (auto& [instance, object] : objectOfInstance_)
    if (object == absorbed) object = kept;
  for (auto& decision : lastDecisions_)
    if (decision.object == absorbed) decision.object = kept;
  objects_.erase(absorbed);
  estimators_.erase(absorbed);
  estimatedFrom_.erase(absorbed);
  estimate(a, true);
}

void CQuadricObjectMap::relabel(ObjectId id, const std::string& label)
{
  MapObject& object = require(id);
  object.labelCounts = {
      {labels_->canonical(label), std::max(1u, object.observations())}
  };
}

void CQuadricObjectMap::remove(ObjectId id)
{
  require(id);
  objects_.erase(id);
  estimators_.erase(id);
  estimatedFrom_.erase(id);
  for (auto it = objectOfInstance_.begin(); it != objectOfInstance_.end();)
    it = it->second == id ? objectOfInstance_.erase(it) : std::next(it);
}

}  // namespace quadmap
