#include "quadmap/slam/points/PointOptions.h"

#include "../OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
void PointOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(
      config, section,
      {"centerSigma", "huber", "maxConfusion", "minJoinPosterior", "mergeLogOdds", "mergeMargin",
       "finalMergeLogOdds", "matureObservations", "forgetAfter", "minObservations",
       "falseAlarmProbability", "confirmLogOdds"});
  readNumber(config, section, "centerSigma", centerSigma, 0.0, 10.0);
  readNumber(config, section, "huber", huber, 0.1, 100.0);
  readNumber(config, section, "maxConfusion", maxConfusion, 1e-6, 1.0);
  readNumber(config, section, "minJoinPosterior", minJoinPosterior, 0.0, 0.999);
  readNumber(config, section, "mergeLogOdds", mergeLogOdds, 0.1, 1000.0);
  readNumber(config, section, "mergeMargin", mergeMargin, 0.0, 1000.0);
  readNumber(config, section, "finalMergeLogOdds", finalMergeLogOdds, 0.1, 1000.0);
  readNumber(config, section, "matureObservations", matureObservations, 1, 1000);
  readNumber(config, section, "forgetAfter", forgetAfter, 1, 100000);
  readNumber(config, section, "minObservations", minObservations, 1, 1000);
  readNumber(config, section, "falseAlarmProbability", falseAlarmProbability, 1e-6, 0.49);
  readNumber(config, section, "confirmLogOdds", confirmLogOdds, -1000.0, 1000.0);
}

void PointOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "centerSigma", optionText(centerSigma));
  config.write(section, "huber", optionText(huber));
  config.write(section, "maxConfusion", optionText(maxConfusion));
  config.write(section, "minJoinPosterior", optionText(minJoinPosterior));
  config.write(section, "mergeLogOdds", optionText(mergeLogOdds));
  config.write(section, "mergeMargin", optionText(mergeMargin));
  config.write(section, "finalMergeLogOdds", optionText(finalMergeLogOdds));
  config.write(section, "matureObservations", matureObservations);
  config.write(section, "forgetAfter", forgetAfter);
  config.write(section, "minObservations", minObservations);
  config.write(section, "falseAlarmProbability", optionText(falseAlarmProbability));
  config.write(section, "confirmLogOdds", optionText(confirmLogOdds));
}

}  // namespace quadmap
