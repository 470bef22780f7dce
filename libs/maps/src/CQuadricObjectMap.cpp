#include "quadmap/maps/CQuadricObjectMap.h"

#include <mrpt/config/CConfigFileBase.h>

#include <ostream>

#include "LabelSource.h"
#include "quadmap/base/ConfigCheck.h"

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

CQuadricObjectMap::CQuadricObjectMap() : labels_(std::make_shared<const LabelSource>()) {}

// Map definition -----------------------------------------------------------------------------

CQuadricObjectMap::TMapDefinition::TMapDefinition() = default;

void CQuadricObjectMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  rejectUnknownSections(
      source, sectionNamePrefix + "_",
      {"creationOpts", "insertOpts", "likelihoodOpts", "perceptionOpts", "renderOpts"});
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

/** A plain pointer before MRPT 2.11.3, a shared one since. */
using CreatedMap = decltype(CQuadricObjectMap::internal_CreateFromMapDefinition(
    std::declval<const mrpt::maps::TMetricMapInitializer&>()));

CreatedMap CQuadricObjectMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& initializer)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(initializer);
  auto map = std::make_unique<CQuadricObjectMap>();
  if (!definition.labelTable.empty()) map->setLabels(LabelTable::fromFile(definition.labelTable));
  map->insertionOptions = definition.insertionOpts;
  map->likelihoodOptions = definition.likelihoodOpts;
  map->renderOptions = definition.renderOpts;
  map->perceptionOptions = definition.perceptionOpts;
  return CreatedMap(map.release());
}

// State --------------------------------------------------------------------------------------

void CQuadricObjectMap::setLabels(LabelTable labels)
{
  labels_ = std::make_shared<const LabelSource>(std::move(labels));
  for (auto& entry : objects_) weighSize(entry.second);
}

const LabelTable& CQuadricObjectMap::labels() const { return labels_->table(); }

const CQuadricObjectMap::Objects& CQuadricObjectMap::objects() const { return objects_; }

const std::vector<CQuadricObjectMap::Decision>& CQuadricObjectMap::lastDecisions() const
{
  return lastDecisions_;
}

bool CQuadricObjectMap::isEmpty() const { return objects_.empty(); }

void CQuadricObjectMap::internal_clear()
{
  objects_.clear();
  nextId_ = 1;
  waiting_.clear();
  pairing_.clear();
  room_ = RoomPlanes();
  objectOfInstance_.clear();
  lastDecisions_.clear();
  together_.clear();
  heirs_.clear();
  unknownLabels_.clear();
}

}  // namespace quadmap
