#pragma once

#include <vector>

#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
constexpr double kMoment = 0.1;  //!< What the cameras of a robot see within it they see at once [s]

/** A recording of one moment, an image of each sensor, needs no odometry. Keeps the images as long
 * as it may be one. */
class SingleMoment
{
 public:
  /** The next frame of the recording; it has no pose. */
  void add(const RgbdFrame& frame);

  /** False once the recording is known to be more; true of one without images. */
  bool isPossible() const { return possible_; }

  void exclude();  //!< A frame had a pose: what came before is of no use

  /** One of each sensor; nothing when the recording is longer than a moment. */
  const std::vector<RgbdFrame>& frames() const { return frames_; }

 private:
  bool possible_ = true;
  std::vector<RgbdFrame> frames_;
};

}  // namespace quadmap
