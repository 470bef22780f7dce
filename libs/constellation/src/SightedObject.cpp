#include "quadmap/constellation/SightedObject.h"

#include <algorithm>

namespace quadmap
{
bool wereSeenTogether(const SightedObject& a, const SightedObject& b)
{
  constexpr double kWrongBoxes = 0.1;  // share of the images
  const auto both = std::count_if(
      a.keyframes.begin(), a.keyframes.end(),
      [&](std::size_t k) { return b.keyframes.count(k) > 0; });
  return static_cast<double>(both) >
         kWrongBoxes * static_cast<double>(std::min(a.keyframes.size(), b.keyframes.size()));
}

}  // namespace quadmap
