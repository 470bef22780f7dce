// A driver of OpenNI2 for a camera that is not there (see TestCamera). Its images go the way of
// those of a real one.
#include <cstdlib>
#include <new>
#define XN_NEW(type, ...)  new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <thread>

#include "TestCamera.h"

namespace
{
using quadmap::TestCamera;
using Clock = std::chrono::steady_clock;

std::uint8_t byteOf(double value)
{
  return static_cast<std::uint8_t>(std::lround(std::min(255.0, std::max(0.0, value))));
}

/** Two pixels (red, green, blue each) as brightness of either and their mean colour: ITU-R BT.601
 * with black at 16 and white at 235, as cameras give it. \param beginsWithU U Y V Y, else Y U Y V.
 */
void packPair(const std::uint8_t* rgb, bool beginsWithU, std::uint8_t* out)
{
  double y[2], u = 128, v = 128;
  for (int i = 0; i < 2; ++i)
  {
    const double r = rgb[3 * i] / 255.0, g = rgb[3 * i + 1] / 255.0, b = rgb[3 * i + 2] / 255.0,
                 luma = 0.299 * r + 0.587 * g + 0.114 * b;
    y[i] = 16 + 219 * luma;
    u += 0.5 * 112 * (b - luma) / 0.886;
    v += 0.5 * 112 * (r - luma) / 0.701;
  }
  const std::uint8_t bytes[4] = {byteOf(u), byteOf(y[0]), byteOf(v), byteOf(y[1])};
  for (int i = 0; i < 4; ++i) out[i] = bytes[beginsWithU ? i : i ^ 1];
}

class Stream : public oni::driver::StreamBase
{
 public:
  Stream(const TestCamera& camera, OniSensorType sensor) : camera_(camera), sensor_(sensor) {}

  static OniVideoMode modeOf(const TestCamera& camera, OniSensorType sensor)
  {
    constexpr OniPixelFormat kColors[] = {
        ONI_PIXEL_FORMAT_RGB888, ONI_PIXEL_FORMAT_YUV422, ONI_PIXEL_FORMAT_YUYV};
    return {
        sensor == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : kColors[camera.colorFormat],
        camera.width, camera.height, std::max(1, static_cast<int>(camera.fps))};
  }

  bool isStarted() const { return isStarted_; }
  OniStatus start() override
  {
    isStarted_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override { isStarted_ = false; }

  OniBool isPropertySupported(int property) override
  {
    return property == ONI_STREAM_PROPERTY_VIDEO_MODE ||
           property == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
           property == ONI_STREAM_PROPERTY_VERTICAL_FOV ||
           property == ONI_STREAM_PROPERTY_MIRRORING || property == ONI_STREAM_PROPERTY_CROPPING ||
           property == ONI_STREAM_PROPERTY_MAX_VALUE || property == ONI_STREAM_PROPERTY_STRIDE;
  }

  OniStatus getProperty(int property, void* data, int* size) override
  {
    switch (property)
    {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(modeOf(camera_, sensor_), data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(static_cast<float>(camera_.horizontalFov), data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(static_cast<float>(camera_.verticalFov), data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(OniBool{camera_.mirrors}, data, size);
      case ONI_STREAM_PROPERTY_CROPPING:  // the recordings of OpenNI2 play nothing without it
        return give(OniCropping{}, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(10000, data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(camera_.width * bytesPerPixel(), data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

  OniStatus setProperty(int property, const void* data, int size) override
  {
    const auto mode = modeOf(camera_, sensor_);
    const bool isSame = property == ONI_STREAM_PROPERTY_VIDEO_MODE && size == sizeof mode &&
                        std::memcmp(data, &mode, sizeof mode) == 0;
    return isSame ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

  /** \param number Of the frame. \param image Index of its image. */
  void send(int number, int image)
  {
    OniFrame* frame = getServices().acquireFrame();
    if (!frame) return;
    const bool isDepth = sensor_ == ONI_SENSOR_DEPTH;
    const auto bytes = static_cast<std::size_t>(camera_.width * camera_.height * bytesPerPixel());
    if (isDepth || camera_.colorFormat == 0)
      std::memcpy(frame->data, isDepth ? camera_.depth(image) : camera_.color(image), bytes);
    else
      for (std::size_t i = 0; 4 * i < bytes; ++i)
        packPair(
            camera_.color(image) + 6 * i, camera_.colorFormat == 1,
            static_cast<std::uint8_t*>(frame->data) + 4 * i);
    frame->dataSize = static_cast<int>(bytes);
    frame->sensorType = sensor_;
    frame->timestamp = static_cast<std::uint64_t>(1e6 * number / camera_.fps);
    frame->frameIndex = number;
    frame->width = camera_.width;
    frame->height = camera_.height;
    frame->videoMode = modeOf(camera_, sensor_);
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->stride = camera_.width * bytesPerPixel();
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  template <typename T>
  static OniStatus give(const T& value, void* data, int* size)
  {
    if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof value);
    *size = sizeof value;
    return ONI_STATUS_OK;
  }
  int bytesPerPixel() const
  {
    return sensor_ == ONI_SENSOR_DEPTH || camera_.colorFormat != 0 ? 2 : 3;
  }

  const TestCamera& camera_;
  const OniSensorType sensor_;
  std::atomic<bool> isStarted_{false};
};

class Device : public oni::driver::DeviceBase
{
 public:
  explicit Device(const TestCamera& camera) :
      camera_(camera),
      modes_{
          Stream::modeOf(camera, ONI_SENSOR_DEPTH), Stream::modeOf(camera, ONI_SENSOR_COLOR)
  },
      sensors_{{ONI_SENSOR_DEPTH, 1, &modes_[0]}, {ONI_SENSOR_COLOR, 1, &modes_[1]}}
  {
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* number) override
  {
    *sensors = sensors_;
    *number = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType sensor) override
  {
    const std::lock_guard lock(mutex);
    auto& stream = sensor == ONI_SENSOR_DEPTH ? depth : color;
    if (!stream) stream = new Stream(camera_, sensor);
    return stream;
  }
  void destroyStream(oni::driver::StreamBase* stream) override
  {
    const std::lock_guard lock(mutex);
    if (stream == depth) depth = nullptr;
    if (stream == color) color = nullptr;
    delete static_cast<Stream*>(stream);
  }

  OniBool isPropertySupported(int property) override
  {
    return property == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override
  {
    return mode == ONI_IMAGE_REGISTRATION_OFF || camera_.registers;
  }
  OniStatus setProperty(int property, const void* data, int size) override
  {
    if (!isPropertySupported(property) || size != sizeof registration_)
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(&registration_, data, sizeof registration_);
    return ONI_STATUS_OK;
  }
  OniStatus getProperty(int property, void* data, int* size) override
  {
    if (!isPropertySupported(property) || *size < static_cast<int>(sizeof registration_))
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(data, &registration_, sizeof registration_);
    return ONI_STATUS_OK;
  }

  std::mutex mutex;  // protects the streams
  Stream *depth = nullptr, *color = nullptr;

 private:
  const TestCamera& camera_;
  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
};

class Driver : public oni::driver::DriverBase
{
 public:
  using DriverBase::DriverBase;

  OniStatus initialize(
      oni::driver::DeviceConnectedCallback connected,
      oni::driver::DeviceDisconnectedCallback disconnected,
      oni::driver::DeviceStateChangedCallback changed,
      void* cookie) override
  {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    const char* file = std::getenv(quadmap::kTestCameraVariable);
    if (!file) return ONI_STATUS_OK;
    camera_ = TestCamera::load(file);
    if (camera_.frames == 0) return ONI_STATUS_ERROR;
    std::strcpy(info_.uri, "quadmap-test");
    std::strcpy(info_.vendor, "quadmap");
    std::strcpy(info_.name, "Test camera");
    deviceConnected(&info_);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override
  {
    device_ = new Device(camera_);
    isOpen_ = true;
    thread_ = std::thread([this] { run(); });
    return device_;
  }
  void deviceClose(oni::driver::DeviceBase*) override
  {
    isOpen_ = false;
    if (thread_.joinable()) thread_.join();
    delete device_;
    device_ = nullptr;
  }
  void shutdown() override {}

  // While OpenNI2 exchanges what receives the frames, it must not receive one.
  void* enableFrameSync(oni::driver::StreamBase**, int) override
  {
    pause();
    return this;
  }
  void disableFrameSync(void*) override { pause(); }

 private:
  void pause()
  {
    const std::lock_guard lock(sending_);
    resume_ = Clock::now() + std::chrono::milliseconds(50);
  }

  void run()
  {
    const auto period =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / camera_.fps));
    int sent = 0;
    auto next = Clock::now();
    while (isOpen_)
    {
      std::this_thread::sleep_until(next);
      next = std::max(next + period, Clock::now() - period);
      if (camera_.silentAfter > 0 && sent >= camera_.silentAfter) continue;
      if (!send(sent)) continue;
      if (++sent == camera_.interruptAfter) ::kill(::getpid(), SIGINT);
      if (camera_.unplugAfter == 0 || sent < camera_.unplugAfter) continue;
      deviceDisconnected(&info_);
      return;
    }
  }

  /** \return False when nobody wants it. */
  bool send(int frame)
  {
    const std::lock_guard lock(sending_);
    const std::lock_guard streams(device_->mutex);
    Stream *depth = device_->depth, *color = device_->color;
    if (!depth || !color || !depth->isStarted() || !color->isStarted() || Clock::now() < resume_)
      return false;
    if (camera_.loseEvery > 0 && (frame + 1) % camera_.loseEvery == 0) return true;
    const int image = std::min(frame, camera_.frames - 1);
    depth->send(camera_.startNumber + frame, image);
    color->send(camera_.startNumber + frame, image);
    return true;
  }

  TestCamera camera_;
  OniDeviceInfo info_ = {};
  Device* device_ = nullptr;
  std::atomic<bool> isOpen_{false};
  std::thread thread_;
  std::mutex sending_;  // protects the next one, and is held while frames are sent
  Clock::time_point resume_ = Clock::now();
};
}  // namespace

ONI_EXPORT_DRIVER(Driver)
