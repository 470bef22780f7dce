#include "quadmap/estimation/AxisRenaming.h"

#include <cmath>

#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
AxisRenaming axisRenaming(int quarterTurns)
{
  AxisRenaming r;
  r.c[3] = quarterTurns * (M_PI / 2);
  if (quarterTurns % 2 != 0)
  {
    r.P(4, 4) = r.P(5, 5) = 0;
    r.P(4, 5) = r.P(5, 4) = 1;
  }
  return r;
}

AxisRenaming axisRenaming(const UprightState& from, const UprightState& to)
{
  return axisRenaming(quarterTurnsTo(from[3], to[3]));
}

}  // namespace quadmap
