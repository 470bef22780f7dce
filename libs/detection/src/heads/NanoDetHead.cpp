#include "heads/NanoDetHead.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
std::vector<RawBox> NanoDetHead::rawBoxes(const std::vector<Tensor>& outputs, float minScore) const
{
  std::vector<RawBox> found;
  for (const GridOutputs& part : grids_)
  {
    const float* scores = outputs[part.scores].data;
    const float* sides = outputs[part.sides].data;
    for (int cell = 0; cell < part.grid.cells(); ++cell, scores += labels_, sides += 4 * bins_)
    {
      const float* best = std::max_element(scores, scores + labels_);
      if (*best >= minScore)
        found.push_back(
            {boxOf(part.grid, cell, sides), static_cast<std::size_t>(best - scores), *best, {}});
    }
  }
  return found;
}

ImageBox NanoDetHead::boxOf(const Grid& grid, int cell, const float* logits) const
{
  const double stride = grid.stride;
  const double x = (cell % grid.columns + 0.5) * stride - 0.5;
  const double y = (cell / grid.columns + 0.5) * stride - 0.5;
  const auto side = [&](int i) { return stride * distance(logits + i * bins_); };
  return {x - side(0), y - side(1), x + side(2), y + side(3)};
}

/** The expected number of the bin. */
double NanoDetHead::distance(const float* logits) const
{
  const float largest = *std::max_element(logits, logits + bins_);
  double sum = 0, weighted = 0;
  for (int k = 0; k < bins_; ++k)
  {
    const double share = std::exp(static_cast<double>(logits[k] - largest));
    sum += share;
    weighted += k * share;
  }
  return weighted / sum;
}

}  // namespace quadmap
