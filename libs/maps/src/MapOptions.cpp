#include "quadmap/maps/MapOptions.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/format.h>

#include <ostream>
#include <set>

#include "quadmap/obs/ConfigCheck.h"

// Every option has one line in a `visit` function: key, field, bounds. Loading, saving and printing
// walk the same lines, so that they cannot disagree.
namespace quadmap
{
namespace
{
constexpr double kLarge = 1e9, kSmall = 1e-9;
constexpr double kRadiansPerDegree = M_PI / 180.0;

template <typename Visitor, typename Options>
void visitInsertion(Visitor& v, Options& o)
{
  v.number("alpha", o.association.alpha, kSmall, kLarge);
  v.number("beta", o.association.beta, kSmall, kLarge);
  v.integer("labels", o.association.labels, 1, 1000000);
  v.number("newObjectVolume", o.association.newObjectVolume, kSmall, kLarge);
  v.number("minJoinPosterior", o.association.minJoinPosterior, 0, 1 - kSmall);
  v.number("extentShare", o.agreement.extentShare, 0, 10);
  v.number("sizeLogSigma", o.agreement.sizeLogSigma, kSmall, 100);
  v.number("maxSizePenalty", o.agreement.maxSizePenalty, 0, 1000);
  v.number("imageWeight", o.agreement.imageWeight, 0, 100);
  v.number("minImageIoU", o.agreement.minImageIoU, kSmall, 1);
  v.number("labelPenalty", o.agreement.labelPenalty, 0, 1000);
  v.number("duplicateIoU", o.agreement.duplicateIoU, kSmall, 1);
  v.integer("maxMeasurementsPerObject", o.estimator.maxMeasurements, 3, 1000000);
  v.integer("maxIterations", o.estimator.maxIterations, 1, 1000);
  v.number("huber", o.estimator.huber, kSmall, 1000);
  v.number("edgeFloor", o.estimator.edgeFloor, 0, 10);
  v.number("edgeShapeShare", o.estimator.edgeShapeShare, 0, 1);
  v.flag("edgesOfComplete", o.estimator.edgesOfComplete);
  v.number("roundnessSigma", o.estimator.roundnessSigma, kSmall, 100);
  v.number("sizePriorSpread", o.estimator.sizePriorSpread, kSmall, 1000);
  v.number("seedWeight", o.estimator.seedWeight, kSmall, 1);
  v.number("posePositionSigma", o.poseNoise.position, 0, 10);
  v.degrees("poseAngleSigma_deg", o.poseNoise.angle, 0, 90);
  v.number("detectionProbability", o.existence.detectionProbability, 0.001, 0.999);
  v.number("falseAlarmProbability", o.existence.falseAlarmProbability, 0.0001, 0.999);
  v.degrees("independentViewAngle_deg", o.existence.independentViewAngle, 0.001, 180);
  v.number("repeatedViewWeight", o.existence.repeatedViewWeight, kSmall, 1);
  v.number("maxLogOdds", o.existence.maxLogOdds, kSmall, 1000);
  v.number("confirmLogOdds", o.existence.confirmLogOdds, -1000, 1000);
  v.integer("minComplete", o.existence.minComplete, 1, 1000000);
  v.integer("minPartial", o.existence.minPartial, 1, 1000000);
  v.number("maxCenterSigma", o.existence.maxCenterSigma, kSmall, 1000);
  v.number("minLabelShare", o.existence.minLabelShare, 0, 1);
  v.number("maxSizeDeviation", o.existence.maxSizeDeviation, kSmall, 1000);
  v.number("maxSizeSigma", o.existence.maxSizeSigma, kSmall, 1000);
  v.number("missMinRange", o.existence.minRange, 0, 1000);
  v.number("missMaxRange", o.existence.maxRange, 0, 1000);
  v.number("missMinBoxSize_px", o.existence.minBoxSize, 0, 10000);
  v.number("missVisibleShare", o.existence.visibleShare, kSmall, 1);
  v.number("missOccluderMargin", o.existence.occluderMargin, 0, 10);
  v.number("missMaxHiddenShare", o.existence.maxHiddenShare, 0, 1);
  v.number("mergeOverlap", o.merging.overlap, kSmall, 1);
  v.number("mergeAnyLabelIoU", o.merging.anyLabelIoU, kSmall, 1);
  v.number("mergePenetration", o.merging.penetration, 0, 10);
  v.number("mergeMinLabelAgreement", o.merging.minLabelAgreement, 0, 1);
  v.integer("waitingCapacity", o.waiting.capacity, 1, 1000000);
  v.integer("waitingMinViews", o.waiting.minViews, 2, 1000);
  v.degrees("waitingMinParallax_deg", o.waiting.minParallax, 0, 180);
  v.number("waitingGateShare", o.waiting.gateShare, kSmall, 100);
  v.number("estimateGrowth", o.estimateGrowth, 0, 10);
  v.flag("useInstanceIds", o.useInstanceIds);
  v.number("minScore", o.minScore, 0, 1);
}

template <typename Visitor, typename Options>
void visitLikelihood(Visitor& v, Options& o)
{
  v.number("positionSigma", o.positionSigma, kSmall, 1000);
  v.degrees("yawSigma_deg", o.yawSigma, kSmall, 360);
  v.degrees("angleSigma_deg", o.angleSigma, kSmall, 360);
  v.number("outlierShare", o.outlierShare, kSmall, 1 - kSmall);
  v.flag("onlyConfirmed", o.onlyConfirmed);
}

template <typename Visitor, typename Options>
void visitRender(Visitor& v, Options& o)
{
  v.flag("cuboids", o.cuboids);
  v.flag("ellipsoids", o.ellipsoids);
  v.flag("labels", o.labels);
  v.flag("unconfirmed", o.unconfirmed);
  v.number("textHeight", o.textHeight, kSmall, 100);
  v.number("opacity", o.opacity, 0, 1);
}

struct Keys
{
  std::set<std::string> names;
  void number(const char* key, const double&, double, double) { names.insert(key); }
  void degrees(const char* key, const double&, double, double) { names.insert(key); }
  template <typename Int>
  void integer(const char* key, const Int&, int, int)
  {
    names.insert(key);
  }
  void flag(const char* key, const bool&) { names.insert(key); }
};

struct Loader
{
  const mrpt::config::CConfigFileBase& source;
  const std::string& section;
  void number(const char* key, double& value, double min, double max)
  {
    readNumber(source, section, key, value, min, max);
  }
  void degrees(const char* key, double& value, double min, double max)
  {
    if (!source.keyExists(section, key)) return;
    double degrees = 0;
    readNumber(source, section, key, degrees, min, max);
    value = degrees * kRadiansPerDegree;
  }
  template <typename Int>
  void integer(const char* key, Int& value, int min, int max)
  {
    int read = static_cast<int>(value);
    readNumber(source, section, key, read, min, max);
    value = static_cast<Int>(read);
  }
  void flag(const char* key, bool& value) { readFlag(source, section, key, value); }
};

/** The shortest text that reads back as the same number. */
std::string exactText(double value)
{
  std::string text;
  for (int digits = 6; digits <= 17; ++digits)
  {
    text = mrpt::format("%.*g", digits, value);
    if (std::stod(text) == value) break;
  }
  return text;
}

/** Hands each option on as text. */
template <typename Write>
struct Writer
{
  Write write;
  void number(const char* key, double value, double, double) { write(key, exactText(value)); }
  void degrees(const char* key, double value, double min, double max)
  {
    number(key, value / kRadiansPerDegree, min, max);
  }
  template <typename Int>
  void integer(const char* key, Int value, int, int)
  {
    write(key, std::to_string(value));
  }
  void flag(const char* key, bool value) { write(key, std::string(value ? "true" : "false")); }
};
template <typename Write>
Writer(Write) -> Writer<Write>;

auto intoConfig(mrpt::config::CConfigFileBase& target, const std::string& section)
{
  return Writer{[&](const char* key, const std::string& text)
                { target.write(section, key, text); }};
}

auto intoText(std::ostream& out)
{
  return Writer{[&](const char* key, const std::string& text)
                { out << mrpt::format("%-28s = %s\n", key, text.c_str()); }};
}

}  // namespace

void InsertionOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  Keys known;
  visitInsertion(known, *this);
  rejectUnknownKeys(source, section, known.names);
  Loader loader{source, section};
  visitInsertion(loader, *this);
  if (existence.falseAlarmProbability >= existence.detectionProbability)
    throw std::invalid_argument(mrpt::format(
        "[%s] falseAlarmProbability=%g: must be less than detectionProbability=%g", section.c_str(),
        existence.falseAlarmProbability, existence.detectionProbability));
}

void InsertionOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& target, const std::string& section) const
{
  auto writer = intoConfig(target, section);
  visitInsertion(writer, *this);
}

void InsertionOptions::dumpToTextStream(std::ostream& out) const
{
  out << "----------- [CQuadricObjectMap::TInsertionOptions] ------------\n";
  auto writer = intoText(out);
  visitInsertion(writer, *this);
}

void LikelihoodOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  Keys known;
  visitLikelihood(known, *this);
  rejectUnknownKeys(source, section, known.names);
  Loader loader{source, section};
  visitLikelihood(loader, *this);
}

void LikelihoodOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& target, const std::string& section) const
{
  auto writer = intoConfig(target, section);
  visitLikelihood(writer, *this);
}

void LikelihoodOptions::dumpToTextStream(std::ostream& out) const
{
  out << "----------- [CQuadricObjectMap::TLikelihoodOptions] ------------\n";
  auto writer = intoText(out);
  visitLikelihood(writer, *this);
}

void RenderOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  Keys known;
  visitRender(known, *this);
  rejectUnknownKeys(source, section, known.names);
  Loader loader{source, section};
  visitRender(loader, *this);
}

void RenderOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& target, const std::string& section) const
{
  auto writer = intoConfig(target, section);
  visitRender(writer, *this);
}

void RenderOptions::dumpToTextStream(std::ostream& out) const
{
  out << "----------- [CQuadricObjectMap::TRenderOptions] ------------\n";
  auto writer = intoText(out);
  visitRender(writer, *this);
}

}  // namespace quadmap
