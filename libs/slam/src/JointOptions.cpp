#include "quadmap/slam/JointOptions.h"

#include "OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
void JointOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(
      config, section,
      {"correctPoses", "window", "rounds", "smallMove", "maxIterations", "tiltSigma_deg",
       "upSigma_deg", "floorSigma"});
  readFlag(config, section, "correctPoses", correctPoses);
  readNumber(config, section, "window", window, 2, 10000);
  readNumber(config, section, "rounds", rounds, 0, 100);
  readNumber(config, section, "smallMove", smallMove, 1e-6, 10.0);
  readNumber(config, section, "maxIterations", maxIterations, 1, 1000);
  readNumber(config, section, "floorSigma", floorSigma, 0.0, 10.0);
  double tilt_deg = mrpt::RAD2DEG(tiltSigma);
  readNumber(config, section, "tiltSigma_deg", tilt_deg, 0.0, 90.0);
  tiltSigma = mrpt::DEG2RAD(tilt_deg);
  double up_deg = mrpt::RAD2DEG(upSigma);
  readNumber(config, section, "upSigma_deg", up_deg, 0.0, 90.0);
  upSigma = mrpt::DEG2RAD(up_deg);
}

void JointOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "correctPoses", correctPoses ? "true" : "false");
  config.write(section, "window", window);
  config.write(section, "rounds", rounds);
  config.write(section, "smallMove", optionText(smallMove));
  config.write(section, "maxIterations", maxIterations);
  config.write(section, "tiltSigma_deg", optionText(mrpt::RAD2DEG(tiltSigma)));
  config.write(section, "upSigma_deg", optionText(mrpt::RAD2DEG(upSigma)));
  config.write(section, "floorSigma", optionText(floorSigma));
}

}  // namespace quadmap
