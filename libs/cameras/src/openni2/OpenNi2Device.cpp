#include "openni2/OpenNi2Device.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/cameras/CameraSource.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

bool isColocated(const openni::Device& device)
{
  return device.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}
}  // namespace

OpenNi2Device::OpenDevice::OpenDevice(const char* uri)
{
  if (device.open(uri) == openni::STATUS_OK) return;
  const std::string why = OpenNi2Library::error();
  if (uri)
    throw std::runtime_error(
        "OpenNI2 cannot open it: it is no recording, or was cut off (" + why + ")");
  throw std::runtime_error(
      "no camera found: is it plugged in, and is there a driver of OpenNI2 for it? (" + why + ")");
}

OpenNi2Device::OpenNi2Device(const char* uri, const CameraOptions& options) :
    open_(uri),
    depth_(open_.device, openni::SENSOR_DEPTH),
    color_(open_.device, openni::SENSOR_COLOR)
{
  watch_.follow(open_.device.getDeviceInfo().getUri());
  description_.isLive = !open_.device.isFile();
  if (description_.isLive)
    prepareCamera(options);
  else
    prepareRecording();
  describe(options);
  depth_.start();
  color_.start();
}

OpenNi2Device::~OpenNi2Device()
{
  depth_.stream().stop();
  color_.stream().stop();
}

void OpenNi2Device::prepareCamera(const CameraOptions& options)
{
  openni::Device& device = open_.device;
  depth_.choose(options);
  color_.choose(options);
  constexpr auto kMode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (device.isImageRegistrationModeSupported(kMode)) device.setImageRegistrationMode(kMode);
  if (!isColocated(device))
    description_.notes.push_back(
        "the camera does not register depth to colour: boxes may be off, by most for near things");
  device.setDepthColorSyncEnabled(true);  // without it images are paired by their times alone
}

void OpenNi2Device::prepareRecording()
{
  openni::PlaybackControl* playback = open_.device.getPlaybackControl();
  // By hand: no image is passed over, and none is waited for.
  constexpr float kByHand = -1;
  if (!playback || playback->setSpeed(kByHand) != openni::STATUS_OK ||
      playback->setRepeatEnabled(false) != openni::STATUS_OK)
    throw std::runtime_error("OpenNI2 cannot play it: " + OpenNi2Library::error());
  const openni::VideoMode depth = depth_.mode(), color = color_.mode();
  if (depth.getResolutionX() != color.getResolutionX() ||
      depth.getResolutionY() != color.getResolutionY())
    throw std::runtime_error(
        "its depth images have another size than its colour images: they are not registered");
  // A recording that was cut off states -1, as the numbers are written when it is closed.
  const int frames = playback->getNumberOfFrames(depth_.stream());
  description_.isCutOff = frames < 0;
  description_.framesInFile = static_cast<std::size_t>(std::max(frames, 0));
  description_.notes.push_back(
      "the recording does not say whether its depth was registered to colour: it is taken to be");
}

void OpenNi2Device::describe(const CameraOptions& options)
{
  const bool isRegistered = !description_.isLive || isColocated(open_.device);
  description_.color = color_.calibration(options);
  description_.depth = isRegistered ? description_.color : depth_.calibration(options);
  const auto format = depth_.mode().getPixelFormat();
  description_.depthUnit = format == openni::PIXEL_FORMAT_DEPTH_100_UM ? 1e-4 : 1e-3;
  description_.fps = std::max(1, depth_.mode().getFps());
}

std::optional<DeviceImage> OpenNi2Device::read(double timeout)
{
  openni::VideoStream* streams[] = {&depth_.stream(), &color_.stream()};
  int ready = -1;
  const int timeout_ms = static_cast<int>(std::lround(1e3 * timeout));
  const auto status = openni::OpenNI::waitForAnyStream(streams, 2, &ready, timeout_ms);
  if (status == openni::STATUS_TIME_OUT) return std::nullopt;
  if (status != openni::STATUS_OK)
    throw std::runtime_error("OpenNI2 gives no images any more: " + OpenNi2Library::error());
  return (ready == 0 ? depth_ : color_).read();
}

std::unique_ptr<CameraSource> openOpenNi2(const std::string& what, const CameraOptions& options)
{
  check(options);
  const bool isLive = what == kLiveCamera;
  const std::string name = isLive ? "openni2:" + what : what;
  std::error_code ignored;  // of names that are too long
  if (!isLive && !fs::is_regular_file(what, ignored))
    throw std::runtime_error(
        name + ": no such file (of OpenNI2; the camera itself is openni2:" + kLiveCamera + ")");
  try
  {
    const std::string path = isLive ? std::string() : fs::absolute(what).string();
    if (path.size() >= ONI_MAX_STR)
      throw std::runtime_error("OpenNI2 only reads files with paths of up to 255 bytes");
    auto device = std::make_unique<OpenNi2Device>(isLive ? nullptr : path.c_str(), options);
    return std::make_unique<CameraSource>(name, std::move(device), options);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(name + ": " + rootMessage(e));
  }
}

}  // namespace quadmap
