#include "quadmap/slam/visual/VisualOdometryOptions.h"

#include <stdexcept>

#include "../OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
namespace
{
/** Every option with its key, factor (INI value times factor = our unit) and bounds. */
struct RealOption
{
  const char* key;
  double VisualOdometryOptions::*value;
  double factor, min, max;
};

constexpr double kDegree = M_PI / 180;

constexpr RealOption kRealOptions[] = {
    {  "minFeatureDistance",  &VisualOdometryOptions::minFeatureDistance,       1,    1,  100},
    {          "sigmaPixel",          &VisualOdometryOptions::sigmaPixel,       1, 0.01,  100},
    {            "minRange",            &VisualOdometryOptions::minRange,       1, 0.01,  100},
    {            "maxRange",            &VisualOdometryOptions::maxRange,       1, 0.02,  100},
    {     "depthSigmaFloor",     &VisualOdometryOptions::depthSigmaFloor,       1, 1e-5,    1},
    {    "depthSigmaGrowth",    &VisualOdometryOptions::depthSigmaGrowth,       1,    0,    1},
    {         "denseWeight",         &VisualOdometryOptions::denseWeight,       1,    0,   10},
    { "keyframeTranslation", &VisualOdometryOptions::keyframeTranslation,       1, 1e-3,   10},
    {"keyframeRotation_deg",    &VisualOdometryOptions::keyframeRotation, kDegree,  0.1,  180},
    {    "keyframeMinShare",    &VisualOdometryOptions::keyframeMinShare,       1,    0,    1},
    {      "minInlierShare",      &VisualOdometryOptions::minInlierShare,       1,    0,    1},
    {    "maxSigmaPosition",    &VisualOdometryOptions::maxSigmaPosition,       1, 1e-5,   10},
    {   "maxSigmaAngle_deg",       &VisualOdometryOptions::maxSigmaAngle, kDegree, 1e-3,  180},
    {            "maxSpeed",            &VisualOdometryOptions::maxSpeed,       1, 1e-3,  100},
    {     "maxTurnRate_deg",         &VisualOdometryOptions::maxTurnRate, kDegree,  0.1, 7200},
    {              "maxGap",              &VisualOdometryOptions::maxGap,       1, 1e-3, 3600},
    {            "gapSpeed",            &VisualOdometryOptions::gapSpeed,       1, 1e-3,  100},
    {     "gapTurnRate_deg",         &VisualOdometryOptions::gapTurnRate, kDegree,  0.1, 7200},
};

}  // namespace

void VisualOdometryOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  std::set<std::string> keys{"features", "minInliers"};
  for (const auto& option : kRealOptions) keys.insert(option.key);
  rejectUnknownKeys(config, section, keys);
  readNumber(config, section, "features", features, 50, 100000);
  readNumber(config, section, "minInliers", minInliers, 6, 100000);
  for (const auto& option : kRealOptions)
  {
    double value = this->*option.value / option.factor;
    readNumber(config, section, option.key, value, option.min, option.max);
    this->*option.value = value * option.factor;
  }
  if (!(minRange < maxRange))
    throw std::invalid_argument(
        "[" + section + "] maxRange=" + optionText(maxRange) + ": must be > minRange (" +
        optionText(minRange) + ")");
}

void VisualOdometryOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "features", features);
  config.write(section, "minInliers", minInliers);
  for (const auto& option : kRealOptions)
    config.write(section, option.key, optionText(this->*option.value / option.factor));
}

}  // namespace quadmap
