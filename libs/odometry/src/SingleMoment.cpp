#include "quadmap/odometry/SingleMoment.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
void SingleMoment::add(const RgbdFrame& frame)
{
  const auto isAnother = [&](const RgbdFrame& other)
  {
    return other.scan->sensorLabel == frame.scan->sensorLabel ||
           std::abs(other.time() - frame.time()) > kMoment;
  };
  if (std::any_of(frames_.begin(), frames_.end(), isAnother)) exclude();
  if (possible_) frames_.push_back(frame);
}

void SingleMoment::exclude()
{
  possible_ = false;
  frames_.clear();
}

}  // namespace quadmap
