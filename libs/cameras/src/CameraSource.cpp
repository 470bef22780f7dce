#include "quadmap/cameras/CameraSource.h"

#include <mrpt/core/Clock.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "DeviceClock.h"
#include "ImagePairs.h"
#include "NewestQueue.h"
#include "RgbdDevice.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/sensors/RgbdScan.h"

namespace quadmap
{
namespace
{
using SteadyClock = std::chrono::steady_clock;

const std::string kCutOff = "the recording is cut off: its end is missing";
constexpr double kPoll = 0.1;  // longest time in which nobody looks whether to end [s]

struct Capture
{
  ImagePairs::Pair images;
  std::size_t number = 0;  // from 0 on
  double time = 0;         // wall time [s]
};

mrpt::obs::CObservation3DRangeScan::Ptr scanOf(
    const Capture& capture, const DeviceDescription& camera)
{
  auto scan = makeRgbdScan(
      capture.time, capture.images.color.pixels, capture.images.depth.pixels, camera.depthUnit);
  scan->cameraParams = camera.depth;
  scan->cameraParamsIntensity = camera.color;
  return scan;
}

CameraOptions checked(CameraOptions options)
{
  check(options);
  return options;
}

/** \exception std::runtime_error For a calibration that the readers of a rawlog would refuse. */
DeviceDescription checked(DeviceDescription device, const std::string& name)
{
  for (const auto* camera : {&device.depth, &device.color})
    if (const auto why = whyNoCalibration(*camera)) throw std::runtime_error(name + " " + *why);
  return device;
}
}  // namespace

void check(const CameraOptions& o)
{
  const auto require = [](bool holds, const char* what)
  {
    if (!holds) throw std::invalid_argument(what);
  };
  require(o.width > 0 && o.height > 0 && o.fps > 0, "resolution: must be > 0");
  if (o.intrinsics)
    require((*o.intrinsics)[0] > 0 && (*o.intrinsics)[1] > 0, "intrinsics: fx and fy must be > 0");
  require(!o.intrinsics || !o.calibration, "intrinsics, calibration: give only one of them");
  if (o.calibration && !(o.calibration->color.fx() > 0 && o.calibration->color.fy() > 0))
    throw std::invalid_argument(o.calibration->origin + ": fx and fy must be > 0 for a device");
  if (o.calibration && o.calibration->isDistorted())
    throw std::invalid_argument(
        o.calibration->origin + " distorts, and images of a device are not rectified");
  require(o.maxPairDelay > 0, "maxPairDelay: must be > 0 s");
  require(o.duration >= 0, "duration: must be >= 0 s");
  require(o.timeout > 0, "timeout: must be > 0 s");
  require(o.mostWaiting > 0, "mostWaiting: must be >= 1");
}

struct CameraSource::Impl
{
  Impl(const std::string& n, std::unique_ptr<RgbdDevice> d, CameraOptions o) :
      name(n),
      device(std::move(d)),
      camera(checked(device->description(), n)),
      options(checked(std::move(o))),
      queue(options.mostWaiting),
      pairs_(std::min(options.maxPairDelay, 0.5 / camera.fps))
  {
    if (camera.isLive) thread_ = std::thread([this] { captureAll(); });
  }

  ~Impl()
  {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  /** The next frame. From a camera it comes from the thread, from a recording at once. */
  std::optional<Capture> next()
  {
    auto capture = camera.isLive ? queue.pop() : captureNext();
    if (capture) ++frames;
    return capture;
  }

  CameraCounts counts() const
  {
    const std::lock_guard lock(mutex_);
    CameraCounts counts = counts_;
    counts.frames = frames;
    counts.skipped = queue.dropped();
    return counts;
  }

  std::optional<std::string> failure() const
  {
    const std::lock_guard lock(mutex_);
    return failure_;
  }

  std::size_t captured() const
  {
    const std::lock_guard lock(mutex_);
    return captured_;
  }

  const std::string name;
  const std::unique_ptr<RgbdDevice> device;
  const DeviceDescription camera;
  const CameraOptions options;
  NewestQueue<Capture> queue;
  std::atomic<std::size_t> frames{0};  //!< That were given to the program

 private:
  void captureAll()
  {
    while (auto capture = captureNext()) queue.push(std::move(*capture));
    queue.close();
  }

  /** The next frame of the device; nothing at the end, whatever ended it. */
  std::optional<Capture> captureNext()
  try
  {
    if (options.frames > 0 && captured() >= options.frames) return std::nullopt;
    const auto begin = SteadyClock::now();
    while (!stopping_ && !(options.isEnded && options.isEnded()))
    {
      const auto state = device->state();
      auto image = device->read(state == RgbdDevice::State::Running ? kPoll : 0);
      if (image)
      {
        image->arrival = mrpt::Clock::nowDouble();
        auto pair = pairs_.add(std::move(*image));
        if (pair) return number(std::move(*pair));
      }
      else if (state != RgbdDevice::State::Running)
      {
        if (state == RgbdDevice::State::Unplugged) fail("the camera was unplugged");
        if (camera.isCutOff) fail(kCutOff);
        return std::nullopt;
      }
      const std::chrono::duration<double> waited = SteadyClock::now() - begin;
      if (waited.count() > options.timeout)
      {
        const std::string what = mrpt::format("no frame for %g s", options.timeout);
        fail(camera.isCutOff ? kCutOff + " (" + what + ")" : what);
        return std::nullopt;
      }
    }
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    fail(camera.isCutOff ? kCutOff + " (" + rootMessage(e) + ")" : rootMessage(e));
    return std::nullopt;
  }

  /** Gives a pair its number and its time; nothing when it is beyond the limit of time. */
  std::optional<Capture> number(ImagePairs::Pair pair)
  {
    const std::lock_guard lock(mutex_);
    const double time = pair.depth.time;
    if (!firstTime_) firstTime_ = time;
    counts_.lost = pairs_.lost();
    counts_.unpaired = pairs_.unpaired();
    constexpr double kRounding = 1e-7;  // of times that a camera gives in microseconds [s]
    if (options.duration > 0 && time - *firstTime_ >= options.duration - kRounding)
      return std::nullopt;
    // A recording's clock counts from 1970 on, and is only made to go forward.
    const double arrival = camera.isLive ? pair.depth.arrival : time;
    counts_.seconds = std::max(counts_.seconds, time - *firstTime_);
    return Capture{std::move(pair), captured_++, clock_.wallTime(time, arrival)};
  }

  void fail(const std::string& what)
  {
    const std::lock_guard lock(mutex_);
    failure_ = name + ": " + what;
  }

  // Used by the thread that reads the device.
  ImagePairs pairs_;
  DeviceClock clock_;
  std::optional<double> firstTime_;  // of the device [s]

  mutable std::mutex mutex_;  // protects the next three
  CameraCounts counts_;
  std::size_t captured_ = 0;  // frames, skipped ones too
  std::optional<std::string> failure_;

  std::atomic<bool> stopping_{false};
  std::thread thread_;  // the last member, as it uses the others
};

CameraSource::CameraSource(
    const std::string& name, std::unique_ptr<RgbdDevice> device, CameraOptions options) :
    FrameSource("CameraSource"),
    impl_(std::make_unique<Impl>(name, std::move(device), std::move(options)))
{
}

CameraSource::~CameraSource() = default;

std::optional<RgbdFrame> CameraSource::read()
{
  const auto capture = impl_->next();
  if (!capture) return std::nullopt;
  RgbdFrame frame;
  frame.record = capture->number;
  frame.scan = scanOf(*capture, impl_->camera);
  return frame;
}

bool CameraSource::isLive() const { return impl_->camera.isLive; }

CameraCounts CameraSource::counts() const { return impl_->counts(); }

std::vector<std::string> CameraSource::notes() const { return impl_->camera.notes; }

std::string CameraSource::lossSummary() const
{
  const CameraCounts c = counts();
  std::string text;
  const auto add = [&text](std::size_t number, const char* what)
  {
    if (number > 0) text += (text.empty() ? "" : ", ") + std::to_string(number) + what;
  };
  add(c.skipped, " frames skipped, as the program was too slow for them");
  add(c.lost, " lost by the camera");
  add(c.unpaired, " without a colour image");
  return text;
}

double CameraSource::progress() const
{
  const auto& o = impl_->options;
  const auto captured = static_cast<double>(impl_->captured());
  double share = 0;
  if (o.duration > 0) share = counts().seconds / o.duration;
  if (o.frames > 0) share = std::max(share, captured / static_cast<double>(o.frames));
  if (impl_->camera.framesInFile > 0)
    share = std::max(share, captured / static_cast<double>(impl_->camera.framesInFile));
  return std::min(share, 1.0);
}

std::size_t CameraSource::recordsRead() const { return impl_->captured(); }

const std::vector<InputProblem>& CameraSource::problems() const
{
  static const std::vector<InputProblem> none;
  return none;
}

std::string CameraSource::contentSummary() const
{
  const CameraCounts c = counts();
  return mrpt::format(
      "%zu frames and %zu depth images without a colour image", c.frames, c.unpaired);
}

std::optional<std::string> CameraSource::failure() const { return impl_->failure(); }

}  // namespace quadmap
