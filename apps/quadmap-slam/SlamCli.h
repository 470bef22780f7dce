#pragma once

#include <string>
#include <vector>

#include "../common/CameraArguments.h"
#include "../common/CommandLine.h"
#include "../common/ReplaceArgument.h"
#include "quadmap/slam/SlamConfiguration.h"

namespace quadmap
{
/** The arguments of quadmap-slam. */
struct SlamCli
{
  cli::CommandLine line{
      "quadmap-slam",
      "Makes the trajectory and the object map of an RGB-D rawlog or of a camera. Boxes come from "
      "the rawlog, from NAME.objects.rawlog beside it, or from --detector. Ctrl-C ends a camera. "
      "It stops a recording early: the files then hold what was done, and the exit status is 130 "
      "(143 after SIGTERM). A second one ends at once and changes nothing.",
      QUADMAP_VERSION};
  std::vector<std::string> methodNames{"rgbd", "quadric", "point", "odometry"};
  std::vector<std::string> associationNames{"estimated", "given"};
  TCLAP::ValuesConstraint<std::string> methods{methodNames}, associations{associationNames};
  TCLAP::UnlabeledValueArg<std::string> rawlog{
      "rawlog",
      "The recording, in either format of MRPT; or openni2:live, the plugged-in camera, or "
      "openni2:FILE.oni, a recording of one.",
      true,
      "",
      "IN.rawlog|openni2:...",
      line.args()};
  cli::Example mapping{
      line, "quadmap-slam home.rawlog -o home",
      "Maps a recording with its own odometry and the boxes of home.objects.rawlog."};
  cli::Example detecting{
      line, "quadmap-slam openni2:live -o desk --detector nanodet-m",
      "Maps from a camera until Ctrl-C; a neural network finds the boxes."};
  cli::Example continuing{
      line, "quadmap-slam today.rawlog -o today --map yesterday/objects.quadmap",
      "Starts in an earlier map and reports what changed."};
  cli::Group results{line, "Results and options"};
  TCLAP::ValueArg<std::string> output{
      "o", "output", "Folder for the results; made when missing.", true, "", "OUTDIR", line.args()};
  TCLAP::ValueArg<std::string> config{
      "c",        "config",   "Options; share/quadmap/quadmap.ini lists them all.", false, "",
      "FILE.ini", line.args()};
  TCLAP::SwitchArg defaults{
      "", "defaults",
      "Given alone: print the options that --config takes, with their defaults and what they do.",
      line.args()};
  cli::Group methodGroup{line, "Method"};
  TCLAP::ValueArg<std::string> method{
      "",
      "method",
      "rgbd: objects from boxes and depth; quadric: from box edges alone, as QuadricSLAM, for "
      "comparison; point: from the centres of the measurements alone, for comparison; odometry: "
      "the trajectory alone.",
      false,
      "rgbd",
      &methods,
      line.args()};
  TCLAP::ValueArg<std::string> odometry{
      "",
      "odometry",
      "Where poses come from: the rawlog's odometry, visual odometry from the images, the rawlog's "
      "ground truth, the nodes of a pose graph, each image that has one being a keyframe; auto: "
      "the rawlog's odometry or, without any, visual odometry; images of one moment need none.",
      false,
      "auto",
      "auto|rawlog|visual|ground-truth|graph:FILE",
      line.args()};
  TCLAP::ValueArg<std::string> association{
      "",
      "association",
      "Which object a box shows. estimated: from labels, positions and sizes; given: by the "
      "instance ids of the boxes.",
      false,
      "estimated",
      &associations,
      line.args()};
  TCLAP::ValueArg<std::string> map{
      "",
      "map",
      "Start in this map of an earlier run, its folder or a file of a map: the place is found from "
      "the objects, results are in the map's frame, and OUTDIR/objects.quadmap is the map brought "
      "up to date.",
      false,
      "",
      "MAP",
      line.args()};
  cli::Group inputGroup{line, "Input"};
  TCLAP::ValueArg<std::string> objects{
      "", "objects", "The file with the boxes.", false, "", "FILE.rawlog", line.args()};
  TCLAP::ValueArg<std::string> detector{
      "",
      "detector",
      "Find the boxes of the keyframes with this model, whatever boxes the input has: its name "
      "(see quadmap-detect --list) or its model file (.ini; see quadmap-detect --help).",
      false,
      "",
      "NAME|FILE",
      line.args()};
  TCLAP::ValueArg<std::string> sensor{"",      "sensor",   "Use only this RGB-D sensor.", false, "",
                                      "LABEL", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Leave out broken records and say so, instead of failing.", line.args()};
  cli::Group running{line, "Running"};
  cli::ReplaceArgument replace{line.args()};
  TCLAP::ValueArg<int> every{
      "",  "every",    "Every n-th frame of a sensor is a keyframe (default: by motion).", false, 0,
      "N", line.args()};
  TCLAP::ValueArg<int> threads{
      "",
      "threads",
      "Threads that work; 0 or none: as many as useful. The results are the same with any number.",
      false,
      0,
      "N",
      line.args()};
  cli::Group cameraGroup{line, "Camera"};
  cli::CameraArguments camera{line.args()};
  TCLAP::ValueArg<std::string> cameraName{
      "",
      "camera",
      "openni2: the calibration of a known camera, scaled to the images (a name of "
      "share/quadmap/cameras or a file), instead of the field of view that the camera states.",
      false,
      "",
      "NAME|FILE",
      line.args()};
};

/** The options of the file, changed by those of the command line.
 * \exception cli::UsageError For a wrong one of the command line.
 * \exception std::runtime_error For a wrong one of the file. */
SlamConfiguration configurationOf(SlamCli& cli);

}  // namespace quadmap
