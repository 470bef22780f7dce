#include "cuboid/HeadingByLines.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** The correction of a heading, and its variance, which grows when the lines contradict each other.
 */
std::optional<LineHeading> meanCorrection(double yaw, const SideLine& lineOf)
{
  constexpr double kMaxCorrection = 10.0 * M_PI / 180.0;
  double information = 0, sum = 0, squares = 0;
  int lines = 0;
  for (int side = 0; side < 4; ++side)
  {
    const auto line = lineOf(yaw + side * M_PI / 2);
    if (!line || std::abs(line->angle) > kMaxCorrection) continue;
    const double weight = 1.0 / (line->variance + kHeadingFloor * kHeadingFloor);
    information += weight;
    sum += weight * -line->angle;  // the normal turns against the slope
    squares += weight * line->angle * line->angle;
    ++lines;
  }
  if (lines == 0) return {};
  const double mean = sum / information;
  const double chi2 = squares - information * mean * mean;
  const double inflation = lines > 1 ? std::max(1.0, chi2 / (lines - 1)) : 1.0;
  return LineHeading{mean, inflation / information};
}

}  // namespace

std::optional<LineHeading> headingByLines(double yaw, const SideLine& lineOf)
{
  std::optional<LineHeading> heading;
  for (int i = 0; i < 2; ++i)
    if (const auto correction = meanCorrection(heading ? heading->yaw : yaw, lineOf))
    {
      const double before = heading ? heading->yaw : yaw;
      const double unsettled = heading ? correction->yaw * correction->yaw : 0.0;
      heading = LineHeading{before + correction->yaw, correction->variance + unsettled};
    }
  return heading;
}

}  // namespace quadmap
