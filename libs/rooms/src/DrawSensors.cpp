#include <algorithm>
#include <cmath>

#include "FurnitureKit.h"
#include "RoomSteps.h"

namespace quadmap::simulator
{
namespace
{
/** To two significant digits, for those who read the scene. */
double plain(double value)
{
  if (value == 0) return 0;
  const double scale = std::pow(10, 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

/** A number about a usual one, mostly within a factor of 1.35. */
double about(FurnitureKit& kit, double usual)
{
  constexpr double kSpread = 0.3;
  return plain(usual * std::exp(std::clamp(kit.gaussian(kSpread), -2 * kSpread, 2 * kSpread)));
}

/** What each calibration gets wrong. */
void drawCalibration(
    SimulatorOptions& options, FurnitureKit& kit, double scaleSigma, double warpSigma)
{
  options.depthNoise.scaleError = plain(kit.gaussian(scaleSigma));
  options.depthNoise.warp = plain(kit.gaussian(warpSigma));
  options.camera.focalError = plain(kit.gaussian(0.004));
}

/** As the first Kinect. */
void drawStructuredLight(SimulatorOptions& options, FurnitureKit& kit)
{
  DepthNoiseOptions& depth = options.depthNoise;
  options.camera.focal = std::round(kit.between(515, 580));
  depth.axialBase = about(kit, 0.0012);
  depth.axialGrowth = about(kit, 0.0019);
  depth.window = std::round(kit.between(6, 9));
  depth.lateral = about(kit, 0.5);
  depth.edgeHoles = about(kit, 0.3);
  depth.darkHoles = about(kit, 0.15);
  drawCalibration(options, kit, 0.005, 0.0008);
}

/** As RealSense: the wide baseline of its window makes rims bleed, and depth is poor beyond 2 m. */
void drawStereo(SimulatorOptions& options, FurnitureKit& kit)
{
  DepthNoiseOptions& depth = options.depthNoise;
  options.camera.focal = std::round(kit.between(590, 640));
  depth.axialBase = about(kit, 0.001);
  depth.axialGrowth = about(kit, 0.004);
  depth.window = std::round(kit.between(8, 14));
  depth.disparityStep = 0.03125;
  depth.baseline = 0.05;
  depth.sensorFocal = 640;
  depth.lateral = about(kit, 0.5);
  depth.edgeHoles = about(kit, 0.15);
  depth.edgeFlying = about(kit, 0.15);
  depth.dropouts = about(kit, 0.01);
  depth.minRange = 0.3;
  depth.bleeding = about(kit, 4);
  depth.darkHoles = about(kit, 0.5);
  drawCalibration(options, kit, 0.007, 0.0015);
}

/** As the second Kinect: exact, but dark things are noisy and rims fly. */
void drawTimeOfFlight(SimulatorOptions& options, FurnitureKit& kit)
{
  DepthNoiseOptions& depth = options.depthNoise;
  options.camera.focal = std::round(kit.between(500, 560));
  depth.axialBase = about(kit, 0.0015);
  depth.axialGrowth = about(kit, 0.0006);
  depth.window = std::round(kit.between(0, 3));
  depth.disparityStep = 0;
  depth.shadow = false;
  depth.lateral = about(kit, 0.3);
  depth.edgeHoles = about(kit, 0.2);
  depth.edgeFlying = about(kit, 0.4);
  depth.darkNoise = about(kit, 3);
  depth.darkHoles = about(kit, 0.3);
  depth.wiggle = about(kit, 0.005);
  drawCalibration(options, kit, 0.003, 0.0006);
}

void drawDetector(DetectorOptions& detector, FurnitureKit& kit)
{
  detector.jitter = about(kit, 2);
  detector.relativeJitter = about(kit, 0.01);
  detector.missRate = about(kit, 0.05);
  detector.occludedMissRate = about(kit, 0.4);
  detector.falseAlarms = about(kit, 0.05);
  detector.flipRate = about(kit, 0.02);
  detector.viewEdges = about(kit, 0.015);
  detector.viewMisses = about(kit, 0.08);
  detector.viewFlips = about(kit, 0.03);
  detector.viewParts = about(kit, 0.04);
  detector.viewMergers = about(kit, 0.05);
}

}  // namespace

void drawSensors(SimulatorOptions& options, FurnitureKit& kit)
{
  using Draw = void (*)(SimulatorOptions&, FurnitureKit&);
  constexpr Draw kSensors[] = {drawStructuredLight, drawStereo, drawTimeOfFlight};
  kSensors[kit.pick(std::size(kSensors))](options, kit);
  options.camera.colorNoise = about(kit, 2);
  options.camera.exposure = about(kit, 0.015);
  drawDetector(options.detector, kit);
}

}  // namespace quadmap::simulator
