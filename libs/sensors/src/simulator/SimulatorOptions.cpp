#include "quadmap/sensors/simulator/SimulatorOptions.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "SceneText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap::simulator
{
namespace
{
Motion motionOf(const Entry& e)
{
  if (e.text == "walk") return Motion::Walk;
  if (e.text == "drive") return Motion::Drive;
  if (e.text == "approach") return Motion::Approach;
  e.reject("must be walk, drive or approach");
}

DetectorOutput outputOf(const Entry& e)
{
  const auto output = detectorOutputOf(e.text);
  if (!output) e.reject("must be boxes, masks, classes or instances");
  return *output;
}

/** \param shares Stay below 1. */
void scaleErrors(
    double factor, const std::vector<double*>& sigmas, const std::vector<double*>& shares)
{
  for (double* sigma : sigmas) *sigma *= factor;
  for (double* share : shares) *share = std::min(1.0, *share * factor);
}

}  // namespace

std::optional<DetectorOutput> detectorOutputOf(const std::string& name)
{
  if (name == "boxes") return DetectorOutput::Boxes;
  if (name == "masks") return DetectorOutput::Masks;
  if (name == "classes") return DetectorOutput::Classes;
  if (name == "instances") return DetectorOutput::Instances;
  return std::nullopt;
}

void CameraOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& c, const std::string& section)
{
  std::set<std::string> known{"width",   "height",    "focal",    "colorNoise", "position",
                              "yaw_deg", "pitch_deg", "roll_deg", "delay"};
  if (section == "camera") known.insert("jpegQuality");
  rejectUnknownKeys(c, section, known);
  readNumber(c, section, "width", width, 64, 4096);
  readNumber(c, section, "height", height, 64, 4096);
  readNumber(c, section, "focal", focal, 10, 10000);
  readNumber(c, section, "colorNoise", colorNoise, 0, 50);
  readNumber(c, section, "jpegQuality", jpegQuality, 1, 100);
  if (const auto e = entryOf(c, section, "position")) position = e->vector(-10, 10);
  readNumber(c, section, "yaw_deg", yaw_deg, -360, 360);
  readNumber(c, section, "pitch_deg", pitch_deg, -90, 90);
  readNumber(c, section, "roll_deg", roll_deg, -360, 360);
  readNumber(c, section, "delay", delay, 0, 10);
}

mrpt::poses::CPose3D CameraOptions::T_robot_camera() const
{
  const Eigen::Vector3d angles(yaw_deg, pitch_deg, roll_deg);
  mrpt::poses::CPose3D pose;
  if (!angles.isZero(0))  // MRPT's rotation by zero has a -0, and identity is to be stored as such
    pose.setYawPitchRoll(mrpt::DEG2RAD(yaw_deg), mrpt::DEG2RAD(pitch_deg), mrpt::DEG2RAD(roll_deg));
  pose.x(position.x());
  pose.y(position.y());
  pose.z(position.z());
  return pose;
}

PinholeCamera CameraOptions::pinhole() const
{
  PinholeCamera camera;
  camera.fx = camera.fy = focal;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  camera.width = static_cast<unsigned>(width);
  camera.height = static_cast<unsigned>(height);
  return camera;
}

void CameraOptions::resize(int newWidth, int newHeight)
{
  focal *= static_cast<double>(newWidth) / width;
  width = newWidth;
  height = newHeight;
}

void TrajectoryOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& c, const std::string& section)
{
  std::set<std::string> known{"kind",      "frames", "rounds",   "duration",
                              "startTime", "bob",    "sway_deg", "stepRate"};
  std::vector<std::string> keys;
  c.getAllKeys(section, keys);
  for (const auto& key : keys)
    if (key.compare(0, 8, "waypoint") == 0) known.insert(key);  // the scene reads these
  rejectUnknownKeys(c, section, known);
  if (const auto e = entryOf(c, section, "kind")) kind = motionOf(*e);
  readNumber(c, section, "frames", frames, 2, 100000);
  readNumber(c, section, "rounds", rounds, 1, 100);
  if (rounds > 1 && kind != Motion::Walk)
    throw std::invalid_argument("[" + section + "] rounds: only a walk is closed");
  readNumber(c, section, "duration", duration, 0.1, 100000);
  readNumber(c, section, "startTime", startTime, 0, 4e9);
  readNumber(c, section, "bob", bob, 0, 0.3);
  readNumber(c, section, "sway_deg", sway_deg, 0, 20);
  readNumber(c, section, "stepRate", stepRate, 0.1, 10);
}

void DepthNoiseOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& c, const std::string& section)
{
  rejectUnknownKeys(
      c, section,
      {"axialBase", "axialGrowth", "window", "disparityStep", "baseline", "sensorFocal", "lateral",
       "edgeJump", "edgeHoles", "edgeFlying", "dropouts", "maxIncidence_deg", "minRange",
       "maxRange", "shadow"});
  readNumber(c, section, "axialBase", axialBase, 0, 1);
  readNumber(c, section, "axialGrowth", axialGrowth, 0, 1);
  readNumber(c, section, "window", window, 0, 64);
  readNumber(c, section, "disparityStep", disparityStep, 0, 4);
  readNumber(c, section, "baseline", baseline, 0.001, 1);
  readNumber(c, section, "sensorFocal", sensorFocal, 10, 10000);
  readNumber(c, section, "lateral", lateral, 0, 10);
  readNumber(c, section, "edgeJump", edgeJump, 0.001, 10);
  readNumber(c, section, "edgeHoles", edgeHoles, 0, 1);
  readNumber(c, section, "edgeFlying", edgeFlying, 0, 1);
  readNumber(c, section, "dropouts", dropouts, 0, 1);
  readNumber(c, section, "maxIncidence_deg", maxIncidence_deg, 1, 90);
  readNumber(c, section, "minRange", minRange, 0, 100);
  readNumber(c, section, "maxRange", maxRange, 0.1, 13);
  readFlag(c, section, "shadow", shadow);
  if (minRange >= maxRange)
    throw std::invalid_argument("[" + section + "] minRange: must be below maxRange");
}

void OdometryOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& c, const std::string& section)
{
  rejectUnknownKeys(
      c, section,
      {"translationPerMetre", "rotationPerMetre_deg", "translationPerRadian",
       "rotationPerRadian_deg", "scale"});
  readNumber(c, section, "translationPerMetre", translationPerMetre, 0, 1);
  readNumber(c, section, "rotationPerMetre_deg", rotationPerMetre_deg, 0, 45);
  readNumber(c, section, "translationPerRadian", translationPerRadian, 0, 1);
  readNumber(c, section, "rotationPerRadian_deg", rotationPerRadian_deg, 0, 45);
  readNumber(c, section, "scale", scale, 0, 0.5);
}

void DetectorOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& c, const std::string& section)
{
  rejectUnknownKeys(
      c, section,
      {"jitter", "relativeJitter", "minVisible", "minSize", "missRate", "occludedMissRate",
       "falseAlarms", "flipRate", "output", "maskJitter", "instanceIds"});
  if (const auto e = entryOf(c, section, "output")) output = outputOf(*e);
  readNumber(c, section, "maskJitter", maskJitter, 0, 50);
  readFlag(c, section, "instanceIds", instanceIds);
  readNumber(c, section, "jitter", jitter, 0, 100);
  readNumber(c, section, "relativeJitter", relativeJitter, 0, 1);
  readNumber(c, section, "minVisible", minVisible, 0, 1);
  readNumber(c, section, "minSize", minSize, 1, 1000);
  readNumber(c, section, "missRate", missRate, 0, 1);
  readNumber(c, section, "occludedMissRate", occludedMissRate, 0, 1);
  readNumber(c, section, "falseAlarms", falseAlarms, 0, 10);
  readNumber(c, section, "flipRate", flipRate, 0, 1);
}

std::vector<CameraOptions> SimulatorOptions::cameras() const
{
  return rig.empty() ? std::vector<CameraOptions>{camera} : rig;
}

void SimulatorOptions::resize(int width, int height)
{
  camera.resize(width, height);
  for (auto& one : rig) one.resize(width, height);
}

void SimulatorOptions::scaleNoise(const NoiseFactors& factors)
{
  camera.colorNoise *= factors.color;
  for (auto& one : rig) one.colorNoise *= factors.color;
  scaleErrors(
      factors.depth,
      {&depthNoise.axialBase, &depthNoise.axialGrowth, &depthNoise.disparityStep,
       &depthNoise.lateral},
      {&depthNoise.edgeHoles, &depthNoise.edgeFlying, &depthNoise.dropouts});
  scaleErrors(
      factors.odometry,
      {&odometry.translationPerMetre, &odometry.rotationPerMetre_deg,
       &odometry.translationPerRadian, &odometry.rotationPerRadian_deg, &odometry.scale},
      {});
  scaleErrors(
      factors.detector,
      {&detector.jitter, &detector.relativeJitter, &detector.maskJitter, &detector.falseAlarms},
      {&detector.missRate, &detector.occludedMissRate, &detector.flipRate});
}

}  // namespace quadmap::simulator
