#include "ObjectRim.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
CellMask::CellMask(const DepthCloud::CellRange& range) : range_(range)
{
  own_.assign(static_cast<std::size_t>(range.cells()), 0);
}

void addRim(
    const BoxCandidates& candidates,
    double gap,
    const std::function<bool(const ObjectCloud::Cell&)>& isFree,
    ObjectCloud& object)
{
  object.mask = CellMask(candidates.range);
  for (const auto& [c, r] : object.cells) object.mask.insert(c, r);
  const int step = object.step;
  if (step == 1) return;
  const CellMask known = object.mask;
  CellMask rejected(candidates.range);
  const std::size_t count = object.cells.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto cell = object.cells[i];
    if (known.surrounds(cell.c, cell.r, step))
    {
      object.mask.insertSquare(cell.c, cell.r, step);
      continue;
    }
    const double z = object.points[i].z();
    for (int r = cell.r - step + 1; r < cell.r + step; ++r)
      for (int c = cell.c - step + 1; c < cell.c + step; ++c)
      {
        if (!candidates.range.contains(c, r) || object.mask.contains(c, r) ||
            rejected.contains(c, r))
          continue;
        const auto p = candidates.rule.candidate(c, r);
        if (!p || !isFree({c, r}))
        {
          rejected.insert(c, r);
          continue;
        }
        if (std::abs(p->z() - z) > gap) continue;
        object.mask.insert(c, r);
        if ((c + r) % step != 0) continue;
        object.cells.push_back({c, r});
        object.points.push_back(*p);
      }
  }
}

}  // namespace quadmap
