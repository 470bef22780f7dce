#pragma once

#include <vector>

#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
constexpr double kMoment = 0.1;  //!< Images within this time are taken as simultaneous [s]

/** Finds out whether a recording is of a single moment, with one image of each sensor. Such a
 * recording needs no odometry. The class keeps the images as long as the answer may be yes. */
class SingleMoment
{
 public:
  /** Takes the next frame of the recording, which has no pose. */
  void add(const RgbdFrame& frame);

  /** False once the recording is known to be longer. It is true before the first image. */
  bool isPossible() const { return possible_; }

  void exclude();  //!< Says that a frame had a pose, so that the recording needs no such treatment

  /** One frame of each sensor; empty when the recording is longer than a moment. */
  const std::vector<RgbdFrame>& frames() const { return frames_; }

 private:
  bool possible_ = true;
  std::vector<RgbdFrame> frames_;
};

}  // namespace quadmap
