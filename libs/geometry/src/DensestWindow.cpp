#include "quadmap/geometry/DensestWindow.h"

namespace quadmap
{
Window densestWindow(const std::vector<double>& sorted, double width)
{
  Window densest;
  std::size_t first = 0;
  for (std::size_t last = 0; last < sorted.size(); ++last)
  {
    while (sorted[last] - sorted[first] > width) ++first;
    const std::size_t count = last + 1 - first;
    if (count > densest.count) densest = {first, count};  // the lowest of equals stays
  }
  return densest;
}

}  // namespace quadmap
