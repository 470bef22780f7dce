#pragma once

#include <string>
#include <vector>

#include "../common/CameraArguments.h"
#include "../common/CommandLine.h"
#include "FolderImport.h"
#include "quadmap/folders/FolderKinds.h"

namespace quadmap
{
inline constexpr const char* kOpenNi2 = "openni2";
inline constexpr const char* kRawlog = "rawlog";
inline constexpr const char* kAuto = "auto";

/** All kinds of sources. */
inline std::vector<std::string> sourceKinds()
{
  auto kinds = folderKinds();
  kinds.emplace_back(kRawlog);
  kinds.emplace_back(kOpenNi2);
  kinds.emplace_back(kAuto);
  return kinds;
}

/** The arguments of quadmap-import. */
struct ImportCli
{
  cli::CommandLine line{
      "quadmap-import",
      "Turns an RGB-D recording into a rawlog that every MRPT program reads, its poses included, "
      "and the boxes of a detector into OUT.objects.rawlog beside it.",
      QUADMAP_VERSION};
  std::vector<std::string> kinds = sourceKinds(), poseKinds{"odometry", "ground-truth", "none"};
  TCLAP::ValuesConstraint<std::string> knownKinds{kinds}, knownPoses{poseKinds};
  TCLAP::UnlabeledValueArg<std::string> kind{
      "kind",
      "What the recording is: a folder as downloaded from, or in the layout of, TUM RGB-D (tum), "
      "ICL-NUIM (icl), 7-Scenes (7scenes) or ScanNet (scannet), or with organised clouds of PCL "
      "(pcd); a rawlog of one or several sensors, as those of Robot@Home (rawlog); a camera by "
      "OpenNI2 (openni2); or auto, which tells the kind of a folder by its files.",
      true,
      "",
      &knownKinds,
      line.args()};
  TCLAP::UnlabeledValueArg<std::string> source{
      "SOURCE",
      "Folder of the recording, or a rawlog; openni2: live, the plugged-in camera, or FILE.oni.",
      true,
      "",
      "SOURCE",
      line.args()};
  cli::Example checking{
      line, "quadmap-import tum my_kitchen --check",
      "Says what is wrong with a recording, and writes nothing."};
  cli::Example importing{
      line, "quadmap-import tum my_kitchen -o kitchen.rawlog", "Makes a rawlog of it."};
  cli::Group outputGroup{line, "Output"};
  TCLAP::ValueArg<std::string> output{"o",          "output",   "The rawlog to write.", false, "",
                                      "OUT.rawlog", line.args()};
  cli::Group checkGroup{line, "Check"};
  TCLAP::SwitchArg check{
      "", "check", "Write nothing; list what is wrong with the recording.", line.args()};
  TCLAP::ValueArg<double> maxGap{
      "",  "max-gap",  "--check: longest time between frames [s] (default: 5 medians).", false, 0,
      "S", line.args()};
  TCLAP::ValueArg<double> maxSpeed{
      "", "max-speed", "--check: fastest plausible motion [m/s].", false, 2.0, "M/S", line.args()};
  cli::Group conversion{line, "Conversion"};
  TCLAP::SwitchArg external{
      "", "external", "Images into OUT_Images/ instead of into the rawlog.", line.args()};
  TCLAP::ValueArg<std::string> posesAs{
      "", "poses-as", "What the poses become.", false, "odometry", &knownPoses, line.args()};
  TCLAP::ValueArg<std::string> trajectory{
      "",
      "trajectory",
      "rawlog: poses of the robot, as quadmap-slam writes them, instead of the rawlog's odometry.",
      false,
      "",
      "FILE.tum",
      line.args()};
  TCLAP::ValueArg<std::string> detections{
      "",
      "detections",
      "Boxes: a folder of text files, one per image, in the form of quadmap or of YOLO's save_txt, "
      "or a JSON file in COCO's form (default SOURCE/detections).",
      false,
      "",
      "DIR|FILE.json",
      line.args()};
  TCLAP::ValueArg<std::string> labels{
      "",
      "labels",
      "Names of the classes, one a line, for boxes that have numbers (default: a file beside them, "
      "or COCO's).",
      false,
      "",
      "FILE",
      line.args()};
  TCLAP::ValueArg<std::string> cameraName{
      "",
      "camera",
      "The camera, when the recording or the device does not tell: a name of share/quadmap/cameras "
      "or a file.",
      false,
      "",
      "NAME|FILE",
      line.args()};
  TCLAP::ValueArg<int> every{"",  "every",    "Take every n-th frame only.", false, 1,
                             "N", line.args()};
  TCLAP::SwitchArg keepGoing{
      "", "keep-going", "Drop what cannot be used, say so, and go on.", line.args()};
  TCLAP::SwitchArg imagesAnywhere{
      "", "images-anywhere", "Read images that lie outside the recording's own folder.",
      line.args()};
  cli::Group cameraGroup{line, "Camera"};
  cli::CameraArguments camera{line.args()};
};

inline PosesAs posesAs(const std::string& name)
{
  if (name == "odometry") return PosesAs::Odometry;
  return name == "none" ? PosesAs::None : PosesAs::GroundTruth;
}

}  // namespace quadmap
