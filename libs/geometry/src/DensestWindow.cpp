#include "quadmap/geometry/DensestWindow.h"

#include <stdexcept>

namespace quadmap
{
Window densestWindow(const std::vector<double>& sorted, double width)
{
  return densestWindow(sorted, std::vector<double>(sorted.size(), 1.0), width);
}

Window densestWindow(
    const std::vector<double>& sorted, const std::vector<double>& weights, double width)
{
  if (weights.size() != sorted.size())
    throw std::invalid_argument("densestWindow: each value needs a weight");
  Window densest;
  std::size_t first = 0;
  double weight = 0, most = 0;
  for (std::size_t last = 0; last < sorted.size(); ++last)
  {
    weight += weights[last];
    while (sorted[last] - sorted[first] > width) weight -= weights[first++];
    if (weight <= most) continue;  // `<=`: the lowest of equals stays
    most = weight;
    densest = {first, last + 1 - first};
  }
  return densest;
}

}  // namespace quadmap
