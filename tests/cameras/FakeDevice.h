#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <stdexcept>
#include <thread>

#include "RgbdDevice.h"
#include "quadmap/cameras/CameraSource.h"

namespace quadmap
{
constexpr int kFakeWidth = 4, kFakeHeight = 3;  // [px]
constexpr double kFakePeriod = 1.0 / 30;        // of its frames [s]

inline DeviceImage fakeImage(DeviceImage::Kind kind, int number, double time)
{
  DeviceImage image;
  image.kind = kind;
  image.number = number;
  image.time = time;
  image.pixels = kind == DeviceImage::Kind::Depth
                     ? cv::Mat(kFakeHeight, kFakeWidth, CV_16UC1, cv::Scalar(1000 + number))
                     : cv::Mat(kFakeHeight, kFakeWidth, CV_8UC3, cv::Scalar(1, 2, 3));
  return image;
}

/** A camera that gives what a test has put in. */
class FakeDevice : public RgbdDevice
{
 public:
  explicit FakeDevice(bool isLive)
  {
    description_.isLive = isLive;
    description_.depth.ncols = description_.color.ncols = kFakeWidth;
    description_.depth.nrows = description_.color.nrows = kFakeHeight;
    description_.depth.setIntrinsicParamsFromValues(4, 4, 1.5, 1);
    description_.color = description_.depth;
  }

  void setFocalLength(double pixels)
  {
    description_.depth.setIntrinsicParamsFromValues(pixels, pixels, 1.5, 1);
  }

  /** Puts in a pair of images. */
  void addPair(int number)
  {
    const double time = 100 + kFakePeriod * number;
    images.push_back(fakeImage(DeviceImage::Kind::Depth, number, time));
    images.push_back(fakeImage(DeviceImage::Kind::Color, number, time + 0.001));
  }

  void cutOff() { description_.isCutOff = true; }  //!< Makes it a recording without an end

  const DeviceDescription& description() const override { return description_; }
  std::optional<DeviceImage> read(double timeout) override
  {
    if (images.empty() && breaks) throw std::runtime_error("something broke");
    if (images.empty())
    {
      std::this_thread::sleep_for(std::chrono::duration<double>(0.01 * timeout));
      return std::nullopt;
    }
    auto image = std::move(images.front());
    images.pop_front();
    return image;
  }
  State state() const override { return images.empty() ? whenEmpty : State::Running; }

  std::deque<DeviceImage> images;
  State whenEmpty = State::AtEnd;
  bool breaks = false;  //!< It throws when it is empty

 private:
  DeviceDescription description_;
};

}  // namespace quadmap
