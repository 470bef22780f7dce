#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "CommandLine.h"
#include "quadmap/cameras/CameraOptions.h"

namespace quadmap::cli
{
/** The arguments of programs that read a camera. */
class CameraArguments
{
 public:
  explicit CameraArguments(TCLAP::CmdLine& line) :
      duration_(
          "",
          "duration",
          "openni2: end after this time of the camera [s] (default: at Ctrl-C).",
          false,
          0,
          "S",
          line),
      frames_("", "frames", "openni2: end after this number of frames.", false, 0, "N", line),
      resolution_(
          "",
          "resolution",
          "openni2:live: size of the images and frames per second to ask for.",
          false,
          "640x480@30",
          "WxH[@FPS]",
          line),
      intrinsics_(
          "",
          "intrinsics",
          "openni2: focal lengths and centre of the images [px] (default: from the field of view "
          "that the camera states).",
          false,
          "",
          "FX,FY,CX,CY",
          line)
  {
  }

  /** For a source that is no camera. \exception UsageError If one of them is given. */
  void requireNone() const
  {
    if (duration_.isSet() || frames_.isSet() || resolution_.isSet() || intrinsics_.isSet())
      throw UsageError("--duration, --frames, --resolution, --intrinsics: for openni2 only");
  }

  /** \exception UsageError For values out of range. */
  CameraOptions options()
  {
    CameraOptions options;
    options.duration = duration_.getValue();
    if (!(options.duration >= 0)) throw UsageError("--duration: must be >= 0 s");
    if (frames_.getValue() < 0) throw UsageError("--frames: must be >= 0");
    options.frames = static_cast<std::size_t>(frames_.getValue());
    readResolution(options);
    if (intrinsics_.isSet()) readIntrinsics(options);
    return options;
  }

  /** The same with the calibration of a known camera. \param camera See cameraPreset().
   *  \exception UsageError For values out of range, and if --intrinsics is given as well.
   *  \exception std::runtime_error If it is not known, or distorts. */
  CameraOptions options(TCLAP::ValueArg<std::string>& camera)
  {
    CameraOptions all = options();
    if (!camera.isSet()) return all;
    if (all.intrinsics) throw UsageError("--intrinsics, --camera: give only one of them");
    all.calibration = cameraPreset(camera.getValue());
    return all;
  }

 private:
  void readResolution(CameraOptions& options)
  {
    char rest = 0;
    const char* text = resolution_.getValue().c_str();
    const int read =
        std::sscanf(text, "%4ux%4u@%3u%c", &options.width, &options.height, &options.fps, &rest);
    const bool hasRate = resolution_.getValue().find('@') != std::string::npos;
    if (read != (hasRate ? 3 : 2) || options.width == 0 || options.height == 0 || options.fps == 0)
      throw UsageError("--resolution: " + resolution_.getValue() + " is not like 640x480@30");
  }

  void readIntrinsics(CameraOptions& options)
  {
    char rest = 0;
    std::array<double, 4> f{};
    const int read = std::sscanf(
        intrinsics_.getValue().c_str(), "%lf,%lf,%lf,%lf%c", &f[0], &f[1], &f[2], &f[3], &rest);
    if (read != 4 || !(f[0] > 0) || !(f[1] > 0))
      throw UsageError(
          "--intrinsics: " + intrinsics_.getValue() + " is not like 525,525,319.5,239.5");
    options.intrinsics = f;
  }

  TCLAP::ValueArg<double> duration_;
  TCLAP::ValueArg<int> frames_;
  TCLAP::ValueArg<std::string> resolution_, intrinsics_;
};

}  // namespace quadmap::cli
