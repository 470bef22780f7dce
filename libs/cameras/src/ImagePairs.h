#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "RgbdDevice.h"

namespace quadmap
{
/** Pairs the depth and the colour images of a camera by their times. */
class ImagePairs
{
 public:
  /** \param maxDelay Most time between the two images of a pair [s], > 0. */
  explicit ImagePairs(double maxDelay) : maxDelay_(maxDelay) {}

  struct Pair
  {
    DeviceImage depth, color;
  };

  /** Takes the next image. \return The pair that it completes. */
  std::optional<Pair> add(DeviceImage image);

  std::size_t unpaired() const { return unpaired_; }  //!< Depth images without a colour image
  std::size_t lost() const { return lost_; }          //!< Depth images that never came

 private:
  void countLost(const DeviceImage& depth);

  double maxDelay_;
  std::optional<DeviceImage> depth_, color_;  //!< Those that wait for a partner
  std::optional<int> lastNumber_;             //!< Of a depth image
  std::size_t unpaired_ = 0, lost_ = 0;
};

}  // namespace quadmap
