#include "quadmap/simulator/SimulatorOptions.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "quadmap/base/OptionList.h"

namespace quadmap::simulator
{
namespace
{
constexpr std::pair<Motion, const char*> kMotions[] = {
    {    Motion::Walk,     "walk"},
    {   Motion::Drive,    "drive"},
    {Motion::Approach, "approach"},
};

constexpr std::pair<DetectorOutput, const char*> kOutputs[] = {
    {    DetectorOutput::Boxes,     "boxes"},
    {    DetectorOutput::Masks,     "masks"},
    {  DetectorOutput::Classes,   "classes"},
    {DetectorOutput::Instances, "instances"},
};

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
  for (const auto& [output, known] : kOutputs)
    if (name == known) return output;
  return std::nullopt;
}

void CameraOptions::describe(OptionList& list)
{
  list.about("The camera: colour and depth share it, as after registration.");
  list.integer("width", width, {64, 4096}, "px", "Width of the images. The Kinect's are VGA.");
  list.integer("height", height, {64, 4096}, "px", "Height of the images.");
  list.number(
      "focal", focal, {10, 10000}, "px",
      "Focal length of both axes. The default is that of the Kinect.");
  list.number(
      "colorNoise", colorNoise, {0, 50}, "of 255",
      "Standard deviation of each colour value. The default is a decent exposure.");
  list.integer(
      "jpegQuality", jpegQuality, {1, 100}, "",
      "Quality of the stored images of all cameras. They look unharmed with the default.");
  list.vector("position", position.data(), {-10, 10}, "m", "Place x y z on the robot.");
  list.number("yaw_deg", yaw_deg, {-360, 360}, "deg", "A positive yaw looks to the left.");
  list.number("pitch_deg", pitch_deg, {-90, 90}, "deg", "A positive pitch looks down.");
  list.number("roll_deg", roll_deg, {-360, 360}, "deg", "Turn about the line of sight.");
  list.number("delay", delay, {0, 10}, "s", "The images come this much after the time of a frame.");
}

mrpt::poses::CPose3D CameraOptions::T_robot_camera() const
{
  const Eigen::Vector3d angles(yaw_deg, pitch_deg, roll_deg);
  mrpt::poses::CPose3D pose;
  if (!angles.isZero(0))  // MRPT's rotation by zero would have a -0 in place of the identity's 0
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

void TrajectoryOptions::describe(OptionList& list)
{
  list.about("How the robot moves along the waypoints of the same section.");
  list.leaveKeys("waypoint");
  list.choice(
      "kind", kind, kMotions,
      "walk is a closed smooth curve, in the hands of somebody who walks. drive is a smooth way on "
      "the floor from the first waypoint to the last. approach goes straight from one to the next, "
      "in the hands of somebody who walks.");
  list.integer("frames", frames, {2, 100000}, "", "Frames of each camera for the whole way.");
  list.integer("rounds", rounds, {1, 100}, "", "A walk goes round so many times in all.");
  list.number(
      "duration", duration, {0.1, 100000}, "s",
      "Time of the whole way. The default is a slow walk around a room.");
  list.number(
      "startTime", startTime, {0, 4e9}, "s since 1970",
      "Time of the first frame. It is fixed, so that results can be reproduced.");
  list.number("bob", bob, {0, 0.3}, "m", "Amplitude of the up and down of the steps.");
  list.number(
      "sway_deg", sway_deg, {0, 20}, "deg", "Amplitude of the pitch and roll of the hands.");
  list.number("stepRate", stepRate, {0.1, 10}, "1/s", "Steps per second while walking.");
  list.require(
      [this] { return rounds == 1 || kind == Motion::Walk; }, "rounds: only a walk is closed");
}

namespace
{
void describeDisparity(DepthNoiseOptions& o, OptionList& list)
{
  list.number(
      "axialBase", o.axialBase, {0, 1}, "m", "Standard deviation of z at 0.4 m, as published.");
  list.number(
      "axialGrowth", o.axialGrowth, {0, 1}, "1/m",
      "Growth of that standard deviation with (z - 0.4 m)^2, as published.");
  list.number(
      "window", o.window, {0, 64}, "px of an image 640 px wide",
      "Side of the square of pixels over which disparity is estimated and its noise is correlated. "
      "0 makes the noise independent. 9 x 7 is published.");
  list.number(
      "disparityStep", o.disparityStep, {0, 4}, "px",
      "Quantum of the disparity, as published. 0 does not round it.");
  list.number(
      "baseline", o.baseline, {0.001, 1}, "m",
      "Distance from the projector to the camera. The default is the Kinect's.");
  list.number(
      "sensorFocal", o.sensorFocal, {10, 10000}, "px",
      "Focal length of the infrared camera. The default is the Kinect's with VGA images.");
  list.number(
      "lateral", o.lateral, {0, 10}, "px of an image 640 px wide",
      "Standard deviation of the sampled position, as published.");
}

void describeGaps(DepthNoiseOptions& o, OptionList& list)
{
  list.number("edgeJump", o.edgeJump, {0.001, 10}, "", "Relative jump of z that makes an edge.");
  list.number("edgeHoles", o.edgeHoles, {0, 1}, "", "Share of edge pixels without depth.");
  list.number(
      "edgeFlying", o.edgeFlying, {0, 1}, "",
      "Share of edge pixels with a depth between the two surfaces.");
  list.number("dropouts", o.dropouts, {0, 1}, "", "Share of all pixels without depth.");
  list.number(
      "maxIncidence_deg", o.maxIncidence_deg, {1, 90}, "deg",
      "Nothing returns from a surface seen at a flatter angle.");
  list.number("minRange", o.minRange, {0, 100}, "m", "Nearer surfaces give no depth.");
  list.number(
      "maxRange", o.maxRange, {0.1, 13}, "m",
      "Farther surfaces give no depth. 16 bits in steps of 0.2 mm end at 13 m.");
  list.flag(
      "shadow", o.shadow, "True gives no depth where the light of the projector does not reach.");
}

}  // namespace

void DepthNoiseOptions::describe(OptionList& list)
{
  list.about("Noise of the depth of a structured-light camera.");
  describeDisparity(*this, list);
  describeGaps(*this, list);
  list.requireLess("minRange", "maxRange");
}

void OdometryOptions::describe(OptionList& list)
{
  list.about("Odometry: a random walk of the pose and one error of scale for the whole run.");
  list.number(
      "translationPerMetre", translationPerMetre, {0, 1}, "m",
      "Standard deviation of each axis after 1 m. The default is fair visual odometry.");
  list.number(
      "rotationPerMetre_deg", rotationPerMetre_deg, {0, 45}, "deg",
      "Standard deviation of the turn about each axis after 1 m.");
  list.number(
      "translationPerRadian", translationPerRadian, {0, 1}, "m",
      "Standard deviation of each axis after turning by 1 rad.");
  list.number(
      "rotationPerRadian_deg", rotationPerRadian_deg, {0, 45}, "deg",
      "Standard deviation of the turn about each axis after turning by 1 rad.");
  list.number("scale", scale, {0, 0.5}, "", "Standard deviation of the relative error of scale.");
}

namespace
{
void describeOutput(DetectorOptions& o, OptionList& list)
{
  list.choice(
      "output", o.output, kOutputs,
      "boxes gives boxes. masks gives boxes with masks. classes labels the pixels of the scan by "
      "label. instances labels them by label and number.");
  list.number(
      "maskJitter", o.maskJitter, {0, 50}, "px of an image 640 px wide",
      "Standard deviation of the border of a mask. The default is that of a grid of stride 4.");
  list.flag(
      "instanceIds", o.instanceIds,
      "True gives boxes the number of their object. False alarms have none.");
}

}  // namespace

void DetectorOptions::describe(OptionList& list)
{
  constexpr const char* kPixels = "px of an image 640 px wide";
  list.about("What a detector finds in the images.");
  describeOutput(*this, list);
  list.number("jitter", jitter, {0, 100}, kPixels, "Standard deviation of each edge of a box.");
  list.number(
      "relativeJitter", relativeJitter, {0, 1}, "",
      "The rest of it, as a share of the square root of width times height of the box.");
  list.number(
      "minVisible", minVisible, {0, 1}, "",
      "Nothing is found below this visible share of the outline.");
  list.number(
      "minSize", minSize, {1, 1000}, kPixels,
      "Smallest square root of width times height of a box that is found.");
  list.number("missRate", missRate, {0, 1}, "", "Share of fully visible objects that are missed.");
  list.number(
      "occludedMissRate", occludedMissRate, {0, 1}, "",
      "Share of objects that are missed when just minVisible of them is left.");
  list.number("falseAlarms", falseAlarms, {0, 10}, "per frame", "Number of boxes around nothing.");
  list.number(
      "flipRate", flipRate, {0, 1}, "",
      "Share of boxes with a label that the object is mistaken for.");
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
