#include "cloud/ObjectRim.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
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
  CellMask settled = known;  // in the mask or rejected
  ObjectCloud::Cell first = {0, 0};
  int inRow = 0;  // known cells with known ones all around, from the first one on
  const auto fillRow = [&]
  {
    for (CellMask* mask : {&object.mask, &settled})
      mask->insert(first.c, first.r, inRow * step, inRow > 0 ? step : 0);
    inRow = 0;
  };
  const auto& range = candidates.range;
  const std::size_t count = object.cells.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto cell = object.cells[i];
    if (known.surrounds(cell.c, cell.r, step))
    {
      if (cell.r != first.r || cell.c != first.c + inRow * step) fillRow();
      if (inRow == 0) first = cell;
      ++inRow;
      continue;
    }
    fillRow();
    const double z = object.points[i].z();
    const int endC = std::min(range.c1, cell.c + step), endR = std::min(range.r1, cell.r + step);
    for (int r = std::max(range.r0, cell.r - step + 1); r < endR; ++r)
      for (int c = std::max(range.c0, cell.c - step + 1); c < endC; ++c)
      {
        if (settled.contains(c, r)) continue;
        if (std::abs(double(candidates.rule.depth(c, r)) - z) > gap) continue;
        settled.insert(c, r);
        const auto p = candidates.rule.candidate(c, r);
        if (!p || !isFree({c, r})) continue;
        object.mask.insert(c, r);
        if ((c + r) % step != 0) continue;
        object.cells.push_back({c, r});
        object.points.push_back(*p);
      }
  }
  fillRow();
}

}  // namespace quadmap
