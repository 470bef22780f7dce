#include "quadmap/perception/PerceptionOptions.h"

#include <mrpt/core/bits_math.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
namespace
{
/** One row per number: name, member, bounds. Reading, writing and the check of keys all use it. */
struct NumberOption
{
  const char* key;
  double PerceptionOptions::*member;
  double min, max;
};

constexpr NumberOption kNumbers[] = {
    {              "minRange",               &PerceptionOptions::minRange, 1e-3,  100},
    {              "maxRange",               &PerceptionOptions::maxRange, 1e-3, 1000},
    {       "depthSigmaFloor",        &PerceptionOptions::depthSigmaFloor, 1e-6,    1},
    {      "depthSigmaGrowth",       &PerceptionOptions::depthSigmaGrowth,    0,    1},
    {          "planeMinArea",           &PerceptionOptions::planeMinArea, 1e-5,    1},
    {        "planeTolerance",         &PerceptionOptions::planeTolerance, 1e-4,    1},
    {             "boxMargin",              &PerceptionOptions::boxMargin,    0,    1},
    { "clusterToleranceShare",  &PerceptionOptions::clusterToleranceShare, 1e-3,    1},
    {      "clusterTolerance",       &PerceptionOptions::clusterTolerance, 1e-3,    1},
    {"clusterToleranceGrowth", &PerceptionOptions::clusterToleranceGrowth,    0,    1},
    {       "yawMinDominance",        &PerceptionOptions::yawMinDominance,    0,    1},
    {        "minCompleteIoU",         &PerceptionOptions::minCompleteIoU,    0,    1},
    {      "minDepthCoverage",       &PerceptionOptions::minDepthCoverage,    0,    1},
    {          "borderMargin",           &PerceptionOptions::borderMargin,    0, 1000},
    {        "occlusionStrip",         &PerceptionOptions::occlusionStrip,    1,  200},
    {  "maxHiddenProbability",   &PerceptionOptions::maxHiddenProbability,    0,    1},
    {         "edgeTolerance",          &PerceptionOptions::edgeTolerance, 1e-3, 1000},
    {             "edgeSigma",              &PerceptionOptions::edgeSigma, 1e-3, 1000},
    {        "edgeSigmaShare",         &PerceptionOptions::edgeSigmaShare,    0,    1},
};

constexpr std::pair<const char*, ObservationModels> kModels[] = {
    {    "both",     ObservationModels::Both},
    {"complete", ObservationModels::Complete},
    { "partial",  ObservationModels::Partial},
};

ObservationModels modelsFrom(const std::string& section, const std::string& name)
{
  for (const auto& [known, models] : kModels)
    if (name == known) return models;
  throw std::invalid_argument(
      "[" + section + "] models=" + name + ": must be both, complete or partial");
}

const char* nameOf(ObservationModels models)
{
  for (const auto& [name, known] : kModels)
    if (known == models) return name;
  return "";
}

}  // namespace

void PerceptionOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  std::set<std::string> known = {"planeMaxTilt_deg", "minPoints", "minLabelPixels", "models"};
  for (const auto& option : kNumbers) known.insert(option.key);
  rejectUnknownKeys(config, section, known);

  for (const auto& option : kNumbers)
    readNumber(config, section, option.key, this->*option.member, option.min, option.max);
  double tilt_deg = mrpt::RAD2DEG(planeMaxTilt);
  readNumber(config, section, "planeMaxTilt_deg", tilt_deg, 0.1, 45);
  planeMaxTilt = mrpt::DEG2RAD(tilt_deg);
  readNumber(config, section, "minPoints", minPoints, 10, 1000000);
  readNumber(config, section, "minLabelPixels", minLabelPixels, 1, 1000000);
  models = modelsFrom(section, config.read_string(section, "models", nameOf(models)));
  if (maxRange <= minRange)
    throw std::invalid_argument(
        "[" + section + "] maxRange=" + std::to_string(maxRange) + ": must be > minRange");
}

void PerceptionOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  for (const auto& option : kNumbers) config.write(section, option.key, this->*option.member);
  config.write(section, "planeMaxTilt_deg", mrpt::RAD2DEG(planeMaxTilt));
  config.write(section, "minPoints", minPoints);
  config.write(section, "minLabelPixels", minLabelPixels);
  config.write(section, "models", std::string(nameOf(models)));
}

}  // namespace quadmap
