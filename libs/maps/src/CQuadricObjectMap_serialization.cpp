#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/optional_serialization.h>
#include <mrpt/serialization/stl_serialization.h>

#include <stdexcept>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
namespace
{
using mrpt::serialization::CArchive;

/** More than this in a file is garbage, not a map. */
constexpr std::uint32_t kMaxObjects = 1000000;

template <typename Options>
void writeOptions(CArchive& out, const Options& options)
{
  mrpt::config::CConfigFileMemory config;
  options.saveToConfigFile(config, "options");
  out << config.getContent();
}

template <typename Options>
void readOptions(CArchive& in, Options& options)
{
  std::string text;
  in >> text;
  options.loadFromConfigFile(mrpt::config::CConfigFileMemory(text), "options");
}

template <typename Matrix>
void writeMatrix(CArchive& out, const Matrix& m)
{
  for (Eigen::Index i = 0; i < m.size(); ++i) out << static_cast<double>(m.data()[i]);
}

template <typename Matrix>
void readMatrix(CArchive& in, Matrix& m)
{
  for (Eigen::Index i = 0; i < m.size(); ++i) in >> m.data()[i];
  if (!m.allFinite())
    throw std::runtime_error("CQuadricObjectMap: the archive has a value that is not a number");
}

void writeObject(CArchive& out, const MapObject& o)
{
  out << o.id << o.completeCount << o.partialCount << o.missCount;
  writeMatrix(out, uprightStateOf(o.object));
  writeMatrix(out, o.covariance);
  out << o.labelCounts << o.orientationDefined << o.existenceLogOdds << o.confirmed << o.firstSeen
      << o.lastSeen;
}

MapObject readObject(CArchive& in)
{
  MapObject o;
  UprightState state;
  in >> o.id >> o.completeCount >> o.partialCount >> o.missCount;
  readMatrix(in, state);
  readMatrix(in, o.covariance);
  in >> o.labelCounts >> o.orientationDefined >> o.existenceLogOdds >> o.confirmed >> o.firstSeen >>
      o.lastSeen;
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
  in >> prior.complete >> prior.yawDefined;
  return prior;
}

}  // namespace

std::uint8_t CQuadricObjectMap::serializeGetVersion() const { return 0; }

/** Version 0: generic parameters, the three groups of options as INI text, the objects with the
 * information their measurements gave, instances. Waiting partial measurements and the label table
 * are not kept. */
void CQuadricObjectMap::serializeTo(CArchive& out) const
{
  out << genericMapParams;
  writeOptions(out, insertionOptions);
  writeOptions(out, likelihoodOptions);
  writeOptions(out, renderOptions);
  out << nextId_ << static_cast<std::uint32_t>(objects_.size());
  for (const auto& [id, object] : objects_)
  {
    writeObject(out, object);
    writePrior(
        out, estimators_.at(id).summary(
                 uprightStateOf(object.object), labels_->properties(object.label()),
                 insertionOptions.estimator));
  }
  out << objectOfInstance_;
}

void CQuadricObjectMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  internal_clear();
  in >> genericMapParams;
  readOptions(in, insertionOptions);
  readOptions(in, likelihoodOptions);
  readOptions(in, renderOptions);
  std::uint32_t count = 0;
  in >> nextId_ >> count;
  if (count > kMaxObjects)
    throw std::runtime_error("CQuadricObjectMap: the archive is damaged (number of objects)");
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const MapObject object = readObject(in);
    estimators_[object.id] = ObjectEstimator::fromSummary(readPrior(in));
    objects_[object.id] = object;
  }
  in >> objectOfInstance_;
}

}  // namespace quadmap
