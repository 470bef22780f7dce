#include "ObjectRim.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** Calls `visit(c, r)` for the cells of a square around one, or only from there to the right and
 * down. */
template <typename Visit>
void forSquare(const ObjectCloud::Cell& from, int before, int after, int step, const Visit& visit)
{
  for (int r = from.r - before; r <= from.r + after; r += step)
    for (int c = from.c - before; c <= from.c + after; c += step) visit(c, r);
}

}  // namespace

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
    bool isInside = true;
    forSquare(cell, step, step, step, [&](int c, int r) { isInside &= known.contains(c, r); });
    if (isInside)
    {
      forSquare(cell, 0, step - 1, 1, [&](int c, int r) { object.mask.insert(c, r); });
      continue;
    }
    const double z = object.points[i].z();
    forSquare(
        cell, step - 1, step - 1, 1,
        [&](int c, int r)
        {
          if (!candidates.range.contains(c, r) || object.mask.contains(c, r) ||
              rejected.contains(c, r))
            return;
          const auto p = candidates.rule.candidate(c, r);
          if (!p || !isFree({c, r}))
          {
            rejected.insert(c, r);
            return;
          }
          if (std::abs(p->z() - z) > gap) return;
          object.mask.insert(c, r);
          if ((c + r) % step != 0) return;
          object.cells.push_back({c, r});
          object.points.push_back(*p);
        });
  }
}

}  // namespace quadmap
