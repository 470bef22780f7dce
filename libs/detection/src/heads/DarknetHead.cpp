#include "heads/DarknetHead.h"

#include <algorithm>

namespace quadmap
{
std::vector<RawBox> DarknetHead::rawBoxes(const std::vector<Tensor>& outputs, float minScore) const
{
  const auto columns = labels_ + kBeforeScores;
  std::vector<RawBox> found;
  for (const Tensor& output : outputs)
    for (const float* row = output.data; row != output.data + output.size(); row += columns)
    {
      const float* scores = row + kBeforeScores;
      const float* best = std::max_element(scores, scores + labels_);
      if (!(*best >= minScore)) continue;
      const double x = row[0] * width_, y = row[1] * height_;
      const double halfWidth = row[2] * width_ / 2, halfHeight = row[3] * height_ / 2;
      found.push_back({
          {x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight},
          static_cast<std::size_t>(best - scores),
          *best,
          {                }
      });
    }
  return found;
}

}  // namespace quadmap
