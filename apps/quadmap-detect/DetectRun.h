#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "quadmap/detection/Detector.h"

namespace quadmap
{
struct DetectRequest
{
  std::string rawlog;
  std::string output;           //!< The file with the boxes
  std::string pictures;         //!< Folder for pictures, see FramePictureFolder; empty for none
  std::string sensorLabel;      //!< The only RGB-D sensor to look at; empty for all
  bool keepGoing = false;       //!< Leave out what is broken instead of throwing
  bool imagesAnywhere = false;  //!< Read external images outside the rawlog's image folder
  /** Called after each frame with the share of the rawlog, in [0, 1], and frames per second. */
  std::function<void(double, double)> onProgress = [](double, double) {};
  std::function<void(const std::string&)> onWarning = [](const std::string&) {};
};

struct DetectSummary
{
  std::size_t frames = 0, boxes = 0;
  std::size_t framesWithoutColour = 0;
  double framesPerSecond = 0;        //!< Of the whole work
  std::vector<std::string> dropped;  //!< One line for each that keepGoing left out
};

/** Looks for objects in all RGB-D frames of a rawlog and writes their boxes, in the order of the
 * frames. The file appears complete or not at all. While one frame is looked at, the next is read.
 * \exception std::runtime_error For a broken input and a full disk. The message names the file. */
DetectSummary detectInRawlog(const DetectRequest& request, Detector& detector);

}  // namespace quadmap
