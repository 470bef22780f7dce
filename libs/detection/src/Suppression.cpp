#include "Suppression.h"

#include <algorithm>

namespace quadmap
{
std::vector<RawBox> suppressOverlaps(
    std::vector<RawBox> rawBoxes, double maxOverlap, std::size_t most)
{
  std::stable_sort(
      rawBoxes.begin(), rawBoxes.end(),
      [](const RawBox& a, const RawBox& b) { return a.score > b.score; });
  std::vector<RawBox> kept;
  for (RawBox& rawBox : rawBoxes)
  {
    if (kept.size() == most) break;
    const auto removes = [&](const RawBox& surer)
    { return surer.label == rawBox.label && imageBoxIoU(surer.box, rawBox.box) > maxOverlap; };
    if (std::none_of(kept.begin(), kept.end(), removes)) kept.push_back(std::move(rawBox));
  }
  return kept;
}

}  // namespace quadmap
