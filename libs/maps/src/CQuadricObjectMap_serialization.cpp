#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "LabelSource.h"
#include "MapLimits.h"
#include "quadmap/base/ArchiveFields.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/estimation/Existence.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
namespace
{
using mrpt::serialization::CArchive;

constexpr std::uint32_t kMaxLabels = 1000;  // of one object

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
  const std::string text = readText(in);
  std::istringstream lines(text);
  requirePlainIni(lines, "its options");
  Options stored;  // what an older archive does not have gets its default
  stored.loadFromConfigFile(mrpt::config::CConfigFileMemory(text), "options");
  options = stored;
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

/** The object of a stored state. Its sizes are chosen so that they have exactly the logarithms
 * stored, and a map that is read is written with the same bytes: exp() may be off in the last bit.
 */
Ellipsoid storedObject(const UprightState& state)
{
  constexpr double kUp = std::numeric_limits<double>::infinity();
  Ellipsoid object = ellipsoidOf(state);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (const double towards : {0.0, kUp})
    {
      if (uprightStateOf(object)[4 + i] == state[4 + i]) break;
      Eigen::Vector3d sizes = object.semiAxes();
      sizes[i] = std::nextafter(sizes[i], towards);
      const Ellipsoid near(object.pose(), sizes);
      if (uprightStateOf(near)[4 + i] == state[4 + i]) object = near;
    }
  return object;
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
  requireStored(
      o.covariance.llt().info() == Eigen::Success,
      "an object's covariance is not positive definite");
  o.object = storedObject(state);
  if (const auto why = whyNoObject(o.object)) requireStored(false, "an object " + *why);
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
  constexpr double kRounding = 1e-5;  // [-], of sums over whole runs
  requireStored(
      isPositiveSemidefinite(prior.L, kRounding),
      "what is known of an object has a negative information");
  readMatrix(in, prior.xi);
  prior.complete = readScalar<std::uint32_t>(in);
  prior.yawDefined = readScalar<std::uint32_t>(in);
  return prior;
}

/** An object that is not where its measurements have it was edited or damaged. The next estimate
 * would take it far away, to no place and no size. Of the objects that maps wrote, those seen once
 * are pulled most, by 2 m and to 25 times their size. */
void requireAgreement(const UprightState& pull, const MapObject& object)
{
  constexpr double kFarthest = 20, kRounding = 1e-3;  // [m], and [-] of the distance to the origin
  constexpr double kMostScale = 10;                   // in the logarithm of a size [-]
  const double distance = pull.head<3>().stableNorm();
  requireStored(
      distance <= kFarthest + kRounding * object.object.center().norm(),
      mrpt::format(
          "object %u (%s) is %g m away from where its measurements have it", object.id,
          object.label().c_str(), distance));
  requireStored(
      pull.tail<3>().cwiseAbs().maxCoeff() <= kMostScale,
      mrpt::format(
          "object %u (%s) has another size than its measurements", object.id,
          object.label().c_str()));
}

}  // namespace

/** An archive of version 1 holds in this order: MRPT's generic parameters, the groups of options as
 * INI text, the label table when there is one, the next id, the objects with the information their
 * measurements gave, and the instances. Version 0 had no label table. What waits for a partner or
 * for more views is not kept. */
std::uint8_t CQuadricObjectMap::serializeGetVersion() const { return 1; }

void CQuadricObjectMap::serializeTo(CArchive& out) const
{
  requireStored(objects_.size() <= kMostStoredObjects, "a map of so many objects cannot be read");
  out << genericMapParams;
  writeOptions(out, insertionOptions);
  writeOptions(out, likelihoodOptions);
  writeOptions(out, renderOptions);
  writeOptions(out, perceptionOptions);
  // An empty map that was given no table need not read one for being stored.
  const bool hasTable = labels_->isGiven() || !objects_.empty();
  out << hasTable;
  if (hasTable) labels().writeTo(out);
  out << nextId_ << static_cast<std::uint32_t>(objects_.size());
  for (const auto& [id, object] : objects_)
  {
    const LabelProperties label = labels().properties(object.label());
    // Doubts are not told apart in the archive, and its sizes say less for it: looks make up.
    MapObject kept = object;
    kept.existenceLogOdds +=
        object.sizeLogOdds - sizeEvidence(
                                 object.object, object.covariance, label,
                                 insertionOptions.existence, insertionOptions.estimator);
    writeObject(out, kept);
    writePrior(
        out, object.estimator.summary(
                 uprightStateOf(object.object), label, insertionOptions.estimator, object.doubts));
  }
  out.WriteAs<std::uint32_t>(objectOfInstance_.size());
  for (const auto& [instance, object] : objectOfInstance_) out << instance << object;
}

void CQuadricObjectMap::serializeFrom(CArchive& in, std::uint8_t version)
try
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  internal_clear();
  in >> genericMapParams;
  readOptions(in, insertionOptions);
  readOptions(in, likelihoodOptions);
  readOptions(in, renderOptions);
  readOptions(in, perceptionOptions);
  auto labels = labels_;
  if (version >= 1)
    labels = readBool(in) ? std::make_shared<const LabelSource>(LabelTable::readFrom(in))
                          : std::make_shared<const LabelSource>();
  nextId_ = readScalar<ObjectId>(in);
  for (auto n = readCount(in, kMostStoredObjects, "objects"); n > 0; --n)
  {
    const MapObject object = readObject(in);
    requireStored(object.id < nextId_ && objects_.count(object.id) == 0, "an object's id is wrong");
    Entry& entry = objects_[object.id];
    static_cast<MapObject&>(entry) = object;
    entry.estimator = ObjectEstimator::fromSummary(readPrior(in));
    entry.looks = ExistenceLooks(object.existenceLogOdds);
    const LabelProperties label = labels->table().properties(object.label());
    entry.sizeLogOdds = sizeEvidence(
        object.object, object.covariance, label, insertionOptions.existence,
        insertionOptions.estimator);
    requireAgreement(
        entry.estimator.pullOfSummary(
            uprightStateOf(object.object), label, insertionOptions.estimator),
        object);
  }
  for (auto n = readCount(in, kMostStoredObjects, "instances"); n > 0; --n)
  {
    const auto instance = readScalar<std::uint32_t>(in);
    const auto id = readScalar<ObjectId>(in);
    requireStored(objects_.count(id) != 0, "an instance belongs to no object");
    objectOfInstance_[instance] = id;
  }
  labels_ = labels;
}
catch (...)
{
  internal_clear();  // half a map is none
  throw;
}

}  // namespace quadmap
