#include "quadmap/sensors/BoxCheck.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace quadmap
{
bool isFarOutside(const ImageBox& box, unsigned width, unsigned height)
{
  constexpr double kFarthest = 10;
  const double far = kFarthest * std::max(width, height);
  const auto isFar = [far](double x) { return std::abs(x) > far; };
  return isFar(box.x1) || isFar(box.y1) || isFar(box.x2) || isFar(box.y2);
}

std::optional<std::string> whyUnusable(
    const ImageBox& box, double score, unsigned width, unsigned height)
{
  const std::string corners =
      mrpt::format("(x1=%g y1=%g x2=%g y2=%g)", box.x1, box.y1, box.x2, box.y2);
  for (const double x : {box.x1, box.y1, box.x2, box.y2})
    if (!std::isfinite(x)) return corners + " has numbers that are not finite";
  if (box.x2 < box.x1 || box.y2 < box.y1) return corners + " is inverted";
  if (!box.isValid()) return corners + " has no area";
  if (isFarOutside(box, width, height))
    return corners + mrpt::format(" reaches far outside the %ux%u image", width, height);
  if (!box.clipped(width, height).isValid())
    return corners + mrpt::format(" lies outside the %ux%u image", width, height);
  if (!(score >= 0 && score <= 1)) return corners + mrpt::format(": score %g not in [0, 1]", score);
  return std::nullopt;
}

}  // namespace quadmap
