#include "edges/Occluders.h"

#include <algorithm>

namespace quadmap
{
Occluders::Occluders(const DepthCloud& cloud, const ImageBox& box, const EdgeContext& context) :
    cloud_(cloud), context_(context), inside_(cloud.cellsOf(box))
{
  for (const auto& screen : context.screens)
    screens_.push_back({cloud.cellsOf(screen.box), screen.depth});
}

bool Occluders::isOnScreen(int c, int r, double limit) const
{
  return std::any_of(
      screens_.begin(), screens_.end(),
      [&](const auto& screen) { return screen.depth < limit && screen.cells.contains(c, r); });
}

}  // namespace quadmap
