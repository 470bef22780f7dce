#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

#include "quadmap/base/OptionGroup.h"
#include "quadmap/geometry/PinholeCamera.h"

namespace quadmap::simulator
{
/** INI section [camera], or [camera NAME] for each camera of a robot with several: what such a
 * section does not say is as in [camera]. Depth and colour share one camera, as after registration.
 * The frame of the robot is x forward, y left, z up. */
struct CameraOptions : public OptionGroup
{
  int width = 640, height = 480;  //!< Image size [px], 64..4096: VGA as the Kinect's
  double focal = 525;             //!< fx = fy [px], 10..10000: the Kinect's default calibration
  double colorNoise = 1.5;        //!< Sigma of each colour value [0..255], 0..50: a decent exposure
  int jpegQuality = 90;           //!< Of the stored images of all cameras, 1..100: looks unharmed
  double focalError = 0;          //!< Relative error of fx and fy as the files have them, -0.2..0.2
  double exposure = 0;            //!< Colour is blurred by the motion of so long [s], 0..0.5
  std::string name = "camera";    //!< NAME, the sensor label
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  //!< On the robot, x y z [m], -10..10
  double yaw_deg = 0;    //!< Positive: looks to the left [deg], -360..360
  double pitch_deg = 0;  //!< Positive: looks down [deg], -90..90
  double roll_deg = 0;   //!< About its line of sight [deg], -360..360
  double delay = 0;      //!< Its images come this much after a frame's time [s], 0..10

  PinholeCamera pinhole() const;                //!< Principal point in the middle of the image
  mrpt::poses::CPose3D T_robot_camera() const;  //!< Camera frame x forward, y left, z up

  /** Another image size with the same field of view. */
  void resize(int newWidth, int newHeight);

 private:
  void describe(OptionList& list) override;
};

/** How the robot moves along the waypoints. */
enum class Motion
{
  Walk,     //!< Closed smooth curve, a camera in the hands of somebody who walks
  Drive,    //!< Smooth way on the floor from the first to the last; the robot frame stays at z = 0
  Approach  //!< Straight from one to the next, in the hands of somebody who walks
};

/** INI section [trajectory]. The way itself is in the waypoints of the same section. */
struct TrajectoryOptions : public OptionGroup
{
  Motion kind = Motion::Walk;  //!< walk, drive or approach
  int frames = 180;            //!< Of each camera for the whole way, 2..100000
  int rounds = 1;              //!< A walk goes round so many times in all, 1..100
  double duration = 45;        //!< Of the whole way [s], 0.1..100000: a slow walk around a room
  double startTime = 1.6e9;  //!< Of the first frame [s since 1970], 0..4e9: fixed, so reproducible
  double bob = 0.02;         //!< Amplitude of the up and down of the steps [m], 0..0.3
  double sway_deg = 1.0;     //!< Amplitude of pitch and roll of the hands [deg], 0..20
  double stepRate = 1.6;     //!< Steps per second, 0.1..10: walking

 private:
  void describe(OptionList& list) override;
};

/** INI section [depth_noise]. By default a structured-light camera: Nguyen, Izadi, Lovell,
 * "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking", 3DIMPVT 2012 (axial,
 * lateral); Khoshelham and Elberink, Sensors 12(2), 2012 (disparity). */
struct DepthNoiseOptions : public OptionGroup
{
  double axialBase = 0.0012;    //!< Sigma of z at 0.4 m [m], 0..1: published
  double axialGrowth = 0.0019;  //!< Its growth with (z - 0.4 m)^2 [1/m], 0..1: published
  double window = 7;  //!< Side of the square of pixels over which disparity is estimated, and its
                      //!< noise correlated [px at 640], 0..64, 0 = independent: published 9x7
  double disparityStep = 0.125;  //!< Quantum of the disparity [px], 0..4, 0 = none: published
  double baseline = 0.075;       //!< Projector to camera [m], 0.001..1: the Kinect's
  double sensorFocal = 580;      //!< Of the infrared camera [px], 10..10000: the Kinect's, VGA
  double lateral = 0.6;          //!< Sigma of the sampled position [px at 640], 0..10: published
  double edgeJump = 0.05;        //!< Relative jump of z that makes an edge, 0.001..10
  double edgeHoles = 0.3;        //!< Share of edge pixels without depth, 0..1
  double edgeFlying = 0.08;      //!< Share of edge pixels between the two surfaces, 0..1
  double dropouts = 0.003;       //!< Share of all pixels without depth, 0..1
  double maxIncidence_deg = 80;  //!< Nothing returns at a flatter angle [deg], 1..90
  double minRange = 0.5;         //!< Nearer surfaces give no depth [m], 0..100
  double maxRange = 8.0;         //!< Farther surfaces give no depth [m], 0.1..13: 16 bit in 0.2 mm
  bool shadow = true;            //!< No depth where the projector's light does not reach
  double bleeding = 0;    //!< Near surfaces cover what is beside them by up to so much, as matching
                          //!< windows do [px at 640], 0..20
  double darkHoles = 0;   //!< Share of black surfaces without depth, in patches, 0..1
  double darkNoise = 0;   //!< Black surfaces have a sigma larger by this factor, less 1, 0..20
  double scaleError = 0;  //!< Relative error of all depth, one calibration's, -0.2..0.2
  double warp = 0;  //!< Error in the middle, and the opposite in corners, over z^2 [1/m], -0.1..0.1
  double wiggle =
      0;  //!< Amplitude of the error that repeats every 1.5 m: time of flight [m], 0..0.1

 private:
  void describe(OptionList& list) override;
};

/** INI section [odometry]. A random walk on SE(3) and one scale error for the whole run. */
struct OdometryOptions : public OptionGroup
{
  double translationPerMetre =
      0.012;  //!< Sigma of each axis after 1 m [m], 0..1: fair visual odometry
  double rotationPerMetre_deg = 0.15;   //!< Sigma of each axis after 1 m [deg], 0..45
  double translationPerRadian = 0.004;  //!< Sigma of each axis after turning 1 rad [m], 0..1
  double rotationPerRadian_deg = 0.3;   //!< Sigma of each axis after turning 1 rad [deg], 0..45
  double scale = 0.005;                 //!< Sigma of the relative scale error, 0..0.5

 private:
  void describe(OptionList& list) override;
};

/** What a detector says of an object it found. */
enum class DetectorOutput
{
  Boxes,
  Masks,     //!< Boxes with masks
  Classes,   //!< No boxes: pixelLabels of the scan, named by label
  Instances  //!< No boxes: pixelLabels of the scan, named by label and number
};

/** Are there labels of pixels instead of boxes? */
inline bool labelsPixels(DetectorOutput output)
{
  return output == DetectorOutput::Classes || output == DetectorOutput::Instances;
}

/** Of "boxes", "masks", "classes" and "instances"; nothing for other names. */
std::optional<DetectorOutput> detectorOutputOf(const std::string& name);

/** INI section [detector]. Sizes in pixels hold for images 640 px wide and scale with the width. */
struct DetectorOptions : public OptionGroup
{
  double jitter = 2;             //!< Sigma of each edge of a box [px at 640], 0..100
  double relativeJitter = 0.01;  //!< The same as a share of the box's sqrt(width * height), 0..1
  double minVisible = 0.25;  //!< Visible share of the outline below which nothing is found, 0..1
  double minSize = 20;       //!< Smallest sqrt(width * height) found [px at 640], 1..1000
  double missRate = 0.05;    //!< Share of fully visible objects missed, 0..1
  double occludedMissRate = 0.4;  //!< Share missed when just minVisible is left, 0..1
  double falseAlarms = 0.05;      //!< Boxes around nothing per frame, 0..10
  DetectorOutput output = DetectorOutput::Boxes;  //!< boxes, masks, classes or instances
  double maskJitter = 1.5;  //!< Sigma of the border of a mask [px at 640], 0..50: a stride 4 grid's
  bool instanceIds = false;  //!< Boxes carry the number of their object; false alarms have none
  double flipRate = 0.03;    //!< Share of boxes with a label the object is mistaken for, 0..1
  double viewAngle_deg =
      20;                  //!< An object looks the same to a network within so much [deg], 1..180
  double viewEdges = 0;    //!< Scale of a view's errors of edges, with long tails: a share of the
                           //!< box's sqrt(width * height), 0..1
  double viewMisses = 0;   //!< Share of views in which an object is not found, 0..1
  double viewFlips = 0;    //!< Share of views with a label the object is mistaken for, 0..1
  double viewParts = 0;    //!< Share of views in which only a part is boxed, 0..1
  double viewMergers = 0;  //!< Share of views in which one box holds the neighbour as well, 0..1

 private:
  void describe(OptionList& list) override;
};

/** What the errors of each part are multiplied with, all in [0, 10]. */
struct NoiseFactors
{
  double color = 1, depth = 1, odometry = 1, detector = 1;

  /** The same for all parts. */
  static NoiseFactors all(double factor) { return {factor, factor, factor, factor}; }
};

struct SimulatorOptions
{
  CameraOptions camera;            //!< The only one, unless there is a rig
  std::vector<CameraOptions> rig;  //!< Several cameras, each with a name of its own
  TrajectoryOptions trajectory;
  DepthNoiseOptions depthNoise;
  OdometryOptions odometry;
  DetectorOptions detector;

  std::vector<CameraOptions> cameras() const;  //!< The rig, or the only camera
  void resize(int width, int height);          //!< All cameras; they keep their fields of view

  /** Multiplies every random error (not the range limits, nor what cannot be seen) with the factor
   * of its part; shares stay below 1. With 0 depth is exact to its storage unit, odometry is the
   * truth and the boxes are those of the visible parts. */
  void scaleNoise(const NoiseFactors& factors);
  void scaleNoise(double factor) { scaleNoise(NoiseFactors::all(factor)); }
};

}  // namespace quadmap::simulator
