#include "Suppression.h"

#include <algorithm>

namespace quadmap
{
std::vector<Candidate> suppressOverlaps(
    std::vector<Candidate> candidates, double maxOverlap, std::size_t most)
{
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates)
  {
    if (kept.size() == most) break;
    const auto removes = [&](const Candidate& surer) {
      return surer.label == candidate.label && imageBoxIoU(surer.box, candidate.box) > maxOverlap;
    };
    if (std::none_of(kept.begin(), kept.end(), removes)) kept.push_back(std::move(candidate));
  }
  return kept;
}

}  // namespace quadmap
