#include "DeviceClock.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
double DeviceClock::wallTime(double device, double arrival)
{
  constexpr double kJump = 1.0;       // the wall clock was set, or the computer slept [s]
  constexpr double kSmallest = 1e-6;  // between two images [s]
  double offset = arrival - device;
  const double passed = last_ ? device - last_->device : 0;
  if (passed > 0)
  {
    if (std::abs(offset - last_->offset) > kJump) offset = last_->offset;
    offset = std::clamp(offset, last_->offset - kSlew * passed, last_->offset + kDrift * passed);
  }
  double wall = device + offset;
  if (last_) wall = std::max(wall, last_->wall + kSmallest);
  last_ = Last{device, offset, wall};
  return wall;
}

}  // namespace quadmap
