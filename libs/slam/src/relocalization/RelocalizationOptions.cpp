#include "quadmap/slam/relocalization/RelocalizationOptions.h"

#include "../OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
void RelocalizationOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(
      config, section,
      {"positionSigma", "yawSigma_deg", "mapSigma", "maxSizeLogRatio", "minLabelAgreement",
       "knownShare", "minPairs", "minLogOdds"});
  readNumber(config, section, "positionSigma", positionSigma, 1e-3, 10.0);
  double yaw_deg = mrpt::RAD2DEG(yawSigma);
  readNumber(config, section, "yawSigma_deg", yaw_deg, 0.01, 90.0);
  yawSigma = mrpt::DEG2RAD(yaw_deg);
  readNumber(config, section, "mapSigma", mapSigma, 1e-3, 10.0);
  readNumber(config, section, "maxSizeLogRatio", maxSizeLogRatio, 0.01, 10.0);
  readNumber(config, section, "minLabelAgreement", minLabelAgreement, 0.0, 1.0);
  readNumber(config, section, "knownShare", knownShare, 0.01, 0.99);
  readNumber(config, section, "minPairs", minPairs, 2, 1000);
  readNumber(config, section, "minLogOdds", minLogOdds, 0.01, 1000.0);
}

void RelocalizationOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "positionSigma", optionText(positionSigma));
  config.write(section, "yawSigma_deg", optionText(mrpt::RAD2DEG(yawSigma)));
  config.write(section, "mapSigma", optionText(mapSigma));
  config.write(section, "maxSizeLogRatio", optionText(maxSizeLogRatio));
  config.write(section, "minLabelAgreement", optionText(minLabelAgreement));
  config.write(section, "knownShare", optionText(knownShare));
  config.write(section, "minPairs", minPairs);
  config.write(section, "minLogOdds", optionText(minLogOdds));
}

}  // namespace quadmap
