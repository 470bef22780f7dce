#pragma once

#include <OpenNI.h>

#include <atomic>
#include <string>

#include "RgbdDevice.h"
#include "quadmap/cameras/CameraOptions.h"

namespace quadmap
{
/** OpenNI2 with its drivers, as long as this object lives. */
class OpenNi2Library
{
 public:
  /** \exception std::runtime_error If no driver can be loaded. */
  OpenNi2Library();
  ~OpenNi2Library();
  OpenNi2Library(const OpenNi2Library&) = delete;
  OpenNi2Library& operator=(const OpenNi2Library&) = delete;

  /** What OpenNI2 says about the latest error, in one line. */
  static std::string error();
};

/** Notices that a device was unplugged, or that a recording ended. */
class OpenNi2Watch :
    public openni::OpenNI::DeviceDisconnectedListener,
    public openni::OpenNI::DeviceStateChangedListener
{
 public:
  OpenNi2Watch();
  ~OpenNi2Watch() override;

  void follow(const std::string& uri) { uri_ = uri; }  //!< Call it before the device is started
  RgbdDevice::State state() const { return state_; }

 private:
  void onDeviceDisconnected(const openni::DeviceInfo* device) override;
  void onDeviceStateChanged(const openni::DeviceInfo* device, openni::DeviceState state) override;

  std::string uri_;
  std::atomic<RgbdDevice::State> state_{RgbdDevice::State::Running};
};

/** A stream of images. */
class OpenNi2Stream
{
 public:
  OpenNi2Stream(openni::Device& device, openni::SensorType sensor);
  ~OpenNi2Stream() { stream_.destroy(); }
  OpenNi2Stream(const OpenNi2Stream&) = delete;
  OpenNi2Stream& operator=(const OpenNi2Stream&) = delete;

  /** Asks a camera for its images. \exception std::runtime_error If it has none of this size. */
  void choose(const CameraOptions& options);

  /** Call it before reading. \exception std::runtime_error If it cannot be started, or gives images
   *  that are not understood. */
  void start();

  openni::VideoStream& stream() { return stream_; }
  openni::VideoMode mode() const { return stream_.getVideoMode(); }
  mrpt::img::TCamera calibration(const CameraOptions& options) const;

  DeviceImage read();

 private:
  bool isDepth() const { return sensor_ == openni::SENSOR_DEPTH; }
  const char* name() const { return isDepth() ? "depth" : "colour"; }
  bool isUnderstood(openni::PixelFormat format) const;
  std::string sizes() const;

  openni::SensorType sensor_;
  openni::VideoStream stream_;
  bool isMirrored_ = false;
};

/** A camera or a recording by OpenNI2. */
class OpenNi2Device : public RgbdDevice
{
 public:
  /** \param uri Path of a recording, or null for the first camera. */
  OpenNi2Device(const char* uri, const CameraOptions& options);
  ~OpenNi2Device() override;

  const DeviceDescription& description() const override { return description_; }
  std::optional<DeviceImage> read(double timeout) override;
  State state() const override { return watch_.state(); }

 private:
  struct OpenDevice
  {
    OpenDevice(const char* uri);
    ~OpenDevice() { device.close(); }
    openni::Device device;
  };

  void prepareCamera(const CameraOptions& options);
  void prepareRecording();
  void describe(const CameraOptions& options);

  OpenNi2Library library_;
  OpenNi2Watch watch_;
  OpenDevice open_;
  OpenNi2Stream depth_, color_;
  DeviceDescription description_;
};

}  // namespace quadmap
