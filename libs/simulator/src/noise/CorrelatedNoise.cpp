#include "noise/CorrelatedNoise.h"

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
/** Weights of a window of some width [px] about its middle pixel. The pixels at its ends count in
 * part. A weighted sum of independent errors has the variance of one of them. */
std::vector<double> windowWeights(double width)
{
  const int reach = static_cast<int>(std::ceil((width - 1) / 2));
  std::vector<double> weights;
  double squares = 0;
  for (int k = -reach; k <= reach; ++k)
  {
    weights.push_back(std::clamp(0.5 * (width + 1) - std::abs(k), 0.0, 1.0));
    squares += weights.back() * weights.back();
  }
  for (double& w : weights) w /= std::sqrt(squares);
  return weights;
}

}  // namespace

std::vector<double> windowedNoise(int width, int height, double window, RandomStream& random)
{
  const auto weights = windowWeights(window);
  const auto n = weights.size();
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  const std::size_t wide = columns + n - 1;  // width with a margin for the window
  std::vector<double> lines((rows + n - 1) * columns, 0.0), line(wide);
  for (std::size_t v = 0; v < rows + n - 1; ++v)
  {
    for (double& x : line) x = random.gaussian();
    for (std::size_t u = 0; u < columns; ++u)
      for (std::size_t k = 0; k < n; ++k) lines[v * columns + u] += weights[k] * line[u + k];
  }
  std::vector<double> result(rows * columns, 0.0);
  for (std::size_t v = 0; v < rows; ++v)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t u = 0; u < columns; ++u)
        result[v * columns + u] += weights[k] * lines[(v + k) * columns + u];
  return result;
}

}  // namespace quadmap::simulator
