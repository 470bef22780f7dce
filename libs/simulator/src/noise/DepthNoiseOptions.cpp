#include "quadmap/base/OptionList.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
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

/** What stereo cameras and cameras by time of flight do, and badly calibrated ones. */
void describeOtherSensors(DepthNoiseOptions& o, OptionList& list)
{
  list.number(
      "bleeding", o.bleeding, {0, 20}, "px of an image 640 px wide",
      "Near surfaces cover what is beside them by up to so much, as the windows of stereo do.");
  list.number(
      "darkHoles", o.darkHoles, {0, 1}, "", "Share of black surfaces without depth, in patches.");
  list.number(
      "darkNoise", o.darkNoise, {0, 20}, "",
      "The standard deviation of black surfaces is larger by this factor, less 1.");
  list.number(
      "scaleError", o.scaleError, {-0.2, 0.2}, "",
      "Relative error of all depth: that of one calibration.");
  list.number(
      "warp", o.warp, {-0.1, 0.1}, "1/m",
      "Error over z^2 in the middle of the image, and the opposite in its corners.");
  list.number(
      "wiggle", o.wiggle, {0, 0.1}, "m",
      "Amplitude of the error that repeats every 1.5 m, as by time of flight.");
}

}  // namespace

void DepthNoiseOptions::describe(OptionList& list)
{
  list.about(
      "Noise of the depth camera. The defaults are a structured-light camera; others are made of "
      "the same errors in other sizes.");
  describeDisparity(*this, list);
  describeGaps(*this, list);
  describeOtherSensors(*this, list);
  list.requireLess("minRange", "maxRange");
}

}  // namespace quadmap::simulator
