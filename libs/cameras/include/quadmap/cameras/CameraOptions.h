#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "quadmap/folders/FolderCamera.h"

namespace quadmap
{
/** How a camera or a recording of one is read. */
struct CameraOptions
{
  /** Size of the images and frames per second that a camera is asked for, all > 0. A recording has
   * its own. */
  unsigned width = 640, height = 480, fps = 30;
  /** Focal lengths and centre (fx, fy, cx, cy) of the images [px]; f > 0. Without them they follow
   * from the field of view that the camera states. */
  std::optional<std::array<double, 4>> intrinsics;
  /** The same from a known camera, whose calibration is scaled to the images; without distortion,
   * and not together with `intrinsics`. */
  std::optional<FolderCamera> calibration;
  double maxPairDelay = 0.02;     //!< Most time between a depth image and its colour image [s], > 0
  double duration = 0;            //!< Ends after this time of the camera's clock [s]; 0: never
  std::size_t frames = 0;         //!< Ends after this number of frames; 0: never
  double timeout = 5;             //!< A camera without frames for this long has failed [s], > 0
  std::size_t mostWaiting = 4;    //!< Most frames of a camera that wait to be taken, >= 1
  std::function<bool()> isEnded;  //!< Asked ten times a second or more; true ends it. May be empty
};

/** Checks the ranges. \exception std::invalid_argument If one is violated. Names the option. */
void check(const CameraOptions& options);

/** What became of the images of a camera. */
struct CameraCounts
{
  std::size_t frames = 0;    //!< Frames that were given to the program
  std::size_t skipped = 0;   //!< Frames that the program was too slow to take
  std::size_t lost = 0;      //!< Depth images that never came, by the numbers they have
  std::size_t unpaired = 0;  //!< Depth images without a colour image of their time
  double seconds = 0;        //!< Time from the first to the last frame by the camera's clock [s]
};

}  // namespace quadmap
