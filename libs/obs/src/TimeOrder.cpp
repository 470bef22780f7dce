#include "quadmap/obs/TimeOrder.h"

#include <mrpt/core/format.h>

namespace quadmap
{
std::optional<std::string> whyOutOfOrder(
    const std::vector<double>& times,
    std::size_t i,
    const std::optional<double>& last,
    const char* what)
{
  const double time = times[i];
  if (last && time <= *last)
    return mrpt::format("time %.6f s is not after the %s before", time, what);
  if (i + 2 >= times.size()) return std::nullopt;
  const double next = times[i + 1], afterNext = times[i + 2];
  if (next < afterNext && afterNext <= time && (!last || next > *last))
    return mrpt::format("time %.6f s is after those of the %ss behind it", time, what);
  return std::nullopt;
}

}  // namespace quadmap
