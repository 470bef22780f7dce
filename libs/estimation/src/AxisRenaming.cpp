#include "quadmap/estimation/AxisRenaming.h"

#include <cmath>

#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
AxisRenaming axisRenaming(const UprightState& from, const UprightState& to)
{
  AxisRenaming r;
  const double yaw = nearestEquivalentYaw(from[3], to[3]);
  r.c[3] = yaw - from[3];
  if (std::lround(r.c[3] / (M_PI / 2)) % 2 != 0)
  {
    r.P(4, 4) = r.P(5, 5) = 0;
    r.P(4, 5) = r.P(5, 4) = 1;
  }
  return r;
}

}  // namespace quadmap
