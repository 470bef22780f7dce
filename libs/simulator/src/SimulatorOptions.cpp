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

/** \param shares Stay below 1. */
void scaleErrors(
    double factor, const std::vector<double*>& sigmas, const std::vector<double*>& shares)
{
  for (double* sigma : sigmas) *sigma *= factor;
  for (double* share : shares) *share = std::min(1.0, *share * factor);
}

}  // namespace

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
  list.number(
      "focalError", focalError, {-0.2, 0.2}, "",
      "Relative error of the focal length in the recording: that of one calibration.");
  list.number(
      "exposure", exposure, {0, 0.5}, "s",
      "The colour image is blurred by the motion of so long, and boxes err by a quarter of the "
      "blur.");
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
  const auto scaleColor = [&](CameraOptions& one)
  {
    one.colorNoise *= factors.color;
    one.exposure *= factors.color;
    one.focalError *= factors.color;
  };
  scaleColor(camera);
  for (auto& one : rig) scaleColor(one);
  scaleErrors(
      factors.depth,
      {&depthNoise.axialBase, &depthNoise.axialGrowth, &depthNoise.disparityStep,
       &depthNoise.lateral, &depthNoise.bleeding, &depthNoise.scaleError, &depthNoise.warp,
       &depthNoise.wiggle},
      {&depthNoise.edgeHoles, &depthNoise.edgeFlying, &depthNoise.dropouts, &depthNoise.darkHoles});
  scaleErrors(
      factors.odometry,
      {&odometry.translationPerMetre, &odometry.rotationPerMetre_deg,
       &odometry.translationPerRadian, &odometry.rotationPerRadian_deg, &odometry.scale},
      {});
  scaleErrors(
      factors.detector,
      {&detector.jitter, &detector.relativeJitter, &detector.maskJitter, &detector.falseAlarms,
       &detector.viewEdges},
      {&detector.missRate, &detector.occludedMissRate, &detector.flipRate, &detector.viewMisses,
       &detector.viewFlips, &detector.viewParts, &detector.viewMergers});
}

}  // namespace quadmap::simulator
