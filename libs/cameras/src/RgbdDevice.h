#pragma once

#include <mrpt/img/TCamera.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** One image as a camera delivers it. */
struct DeviceImage
{
  enum class Kind
  {
    Depth,  //!< 16 bits, in units of DeviceDescription::depthUnit; 0 = none
    Color   //!< 3 x 8 bits, blue first
  };
  Kind kind = Kind::Depth;
  double time = 0;     //!< By the clock of the camera [s]
  double arrival = 0;  //!< Wall time when it was received [s]; set by who reads the camera
  int number = 0;      //!< Images of a stream are numbered without gaps
  cv::Mat pixels;      //!< It owns them
};

/** What a camera says about itself. */
struct DeviceDescription
{
  bool isLive = true;               //!< A camera, not a recording
  mrpt::img::TCamera depth, color;  //!< Calibrations
  double depthUnit = 0.001;         //!< [m]
  double fps = 30;                  //!< Frames per second, > 0
  std::size_t framesInFile = 0;     //!< 0 when it is not known
  bool isCutOff = false;            //!< A recording whose end is missing
  std::vector<std::string> notes;   //!< What a user should know, one line each
};

/** An RGB-D camera or a recording of one. One thread uses it. */
class RgbdDevice
{
 public:
  enum class State
  {
    Running,
    AtEnd,     //!< The recording has no more images
    Unplugged  //!< There will be no more images
  };

  virtual ~RgbdDevice() = default;
  virtual const DeviceDescription& description() const = 0;
  /** The next image of any kind. \param timeout Longest time to wait for one [s].
   *  \return Nothing when none came in time.
   *  \exception std::runtime_error If the camera cannot be read any more. */
  virtual std::optional<DeviceImage> read(double timeout) = 0;
  /** Images that came before the end can still be read. */
  virtual State state() const = 0;
};

}  // namespace quadmap
