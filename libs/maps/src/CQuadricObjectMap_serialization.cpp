#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/ArchiveFields.h"

namespace quadmap
{
namespace
{
using mrpt::serialization::CArchive;

/** More than this in a file is garbage, not a map. */
constexpr std::uint32_t kMaxObjects = 1000000;
constexpr std::uint32_t kMaxLabels = 10000;  // of one object

template <typename Options>
void writeOptions(CArchive& out, const Options& options)
{
  mrpt::config::CConfigFileMemory config;
  options.saveToConfigFile(config, "options");
  writeText(out, config.getContent());
}

template <typename Options>
void readOptions(CArchive& in, Options& options)
{
  options.loadFromConfigFile(mrpt::config::CConfigFileMemory(readText(in)), "options");
}

template <typename Matrix>
void writeMatrix(CArchive& out, const Matrix& m)
{
  for (Eigen::Index i = 0; i < m.size(); ++i) out << static_cast<double>(m.data()[i]);
}

template <typename Matrix>
void readMatrix(CArchive& in, Matrix& m)
{
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = readScalar<double>(in);
  requireStored(m.allFinite(), "a value of the object map is not a number");
}

void writeLabelCounts(CArchive& out, const std::map<std::string, unsigned>& counts)
{
  out.WriteAs<std::uint32_t>(counts.size());
  for (const auto& [label, count] : counts)
  {
    writeText(out, label);
    out.WriteAs<std::uint32_t>(count);
  }
}

std::map<std::string, unsigned> readLabelCounts(CArchive& in)
{
  std::map<std::string, unsigned> counts;
  for (auto n = readCount(in, kMaxLabels, "labels"); n > 0; --n)
  {
    const auto label = readText(in);
    counts[label] = readScalar<std::uint32_t>(in);
  }
  return counts;
}

void writeObject(CArchive& out, const MapObject& o)
{
  out << o.id << o.completeCount << o.partialCount << o.missCount;
  writeMatrix(out, uprightStateOf(o.object));
  writeMatrix(out, o.covariance);
  writeLabelCounts(out, o.labelCounts);
  out << o.orientationDefined << o.existenceLogOdds << o.confirmed << o.firstSeen << o.lastSeen;
}

MapObject readObject(CArchive& in)
{
  MapObject o;
  UprightState state;
  o.id = readScalar<ObjectId>(in);
  for (unsigned* count : {&o.completeCount, &o.partialCount, &o.missCount})
    *count = readScalar<std::uint32_t>(in);
  readMatrix(in, state);
  readMatrix(in, o.covariance);
  o.labelCounts = readLabelCounts(in);
  o.orientationDefined = readBool(in);
  o.existenceLogOdds = readScalar<double>(in);
  o.confirmed = readBool(in);
  in >> o.firstSeen >> o.lastSeen;
  requireStored(std::isfinite(o.existenceLogOdds), "an object's existence is not a number");
  o.object = ellipsoidOf(state);
  return o;
}

void writePrior(CArchive& out, const InformationPrior& prior)
{
  writeMatrix(out, prior.L);
  writeMatrix(out, prior.xi);
  out << prior.complete << prior.yawDefined;
}

InformationPrior readPrior(CArchive& in)
{
  InformationPrior prior;
  readMatrix(in, prior.L);
  readMatrix(in, prior.xi);
  prior.complete = readScalar<std::uint32_t>(in);
  prior.yawDefined = readScalar<std::uint32_t>(in);
  return prior;
}

}  // namespace

std::uint8_t CQuadricObjectMap::serializeGetVersion() const { return 0; }

/** Version 0: generic parameters, the groups of options as INI text, the objects with the
 * information their measurements gave, instances. Waiting partial measurements and the label table
 * are not kept. */
void CQuadricObjectMap::serializeTo(CArchive& out) const
{
  out << genericMapParams;
  writeOptions(out, insertionOptions);
  writeOptions(out, likelihoodOptions);
  writeOptions(out, renderOptions);
  writeOptions(out, perceptionOptions);
  out << nextId_ << static_cast<std::uint32_t>(objects_.size());
  for (const auto& [id, object] : objects_)
  {
    writeObject(out, object);
    writePrior(
        out, estimators_.at(id).summary(
                 uprightStateOf(object.object), labels_->properties(object.label()),
                 insertionOptions.estimator));
  }
  out.WriteAs<std::uint32_t>(objectOfInstance_.size());
  for (const auto& [instance, object] : objectOfInstance_) out << instance << object;
}

void CQuadricObjectMap::serializeFrom(CArchive& in, std::uint8_t version)
try
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  internal_clear();
  in >> genericMapParams;
  readOptions(in, insertionOptions);
  readOptions(in, likelihoodOptions);
  readOptions(in, renderOptions);
  readOptions(in, perceptionOptions);
  nextId_ = readScalar<ObjectId>(in);
  for (auto n = readCount(in, kMaxObjects, "objects"); n > 0; --n)
  {
    const MapObject object = readObject(in);
    requireStored(object.id < nextId_ && objects_.count(object.id) == 0, "an object's id is wrong");
    estimators_[object.id] = ObjectEstimator::fromSummary(readPrior(in));
    objects_[object.id] = object;
  }
  for (auto n = readCount(in, kMaxObjects, "instances"); n > 0; --n)
  {
    const auto instance = readScalar<std::uint32_t>(in);
    objectOfInstance_[instance] = readScalar<ObjectId>(in);
  }
}
catch (...)
{
  internal_clear();  // half a map is none
  throw;
}

}  // namespace quadmap
