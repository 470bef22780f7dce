#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** Which cells of the depth cloud belong to something, in a part of it. */
class CellMask
{
 public:
  CellMask() = default;
  explicit CellMask(const DepthCloud::CellRange& range) :
      range_(range), own_(static_cast<std::size_t>(range.cells()), 0)
  {
  }

  bool contains(int c, int r) const { return range_.contains(c, r) && own_[index(c, r)] != 0; }
  /** Does it contain the eight cells around one, at a distance of `step`? */
  bool surrounds(int c, int r, int step) const
  {
    if (c - step < range_.c0 || r - step < range_.r0 || c + step >= range_.c1 ||
        r + step >= range_.r1)
      return false;
    const std::size_t across = static_cast<std::size_t>(step);
    const std::size_t down = across * static_cast<std::size_t>(range_.c1 - range_.c0);
    const char* own = &own_[index(c, r)];
    const char *above = own - down, *below = own + down;
    return above[0] && below[0] && *(own - across) && own[across] && *(above - across) &&
           above[across] && *(below - across) && below[across];
  }
  /** Cells outside the range are left out. */
  void insert(int c, int r)
  {
    if (range_.contains(c, r)) own_[index(c, r)] = 1;
  }
  /** A rectangle within the range. \param c, r Its first cell. */
  void insert(int c, int r, int columns, int rows)
  {
    for (int i = 0; i < rows; ++i)
      std::fill_n(own_.begin() + static_cast<std::ptrdiff_t>(index(c, r + i)), columns, char(1));
  }
  template <typename Visit>
  void forEach(const Visit& visit) const  //!< Calls visit(c, r) for all cells.
  {
    const DepthCloud::CellRange range = range_;  // its own: a visit cannot change it
    const char* own = own_.data();
    for (int r = range.r0; r < range.r1; ++r)
      for (int c = range.c0; c < range.c1; ++c)
        if (*own++ != 0) visit(c, r);
  }

 private:
  std::size_t index(int c, int r) const
  {
    return static_cast<std::size_t>((r - range_.r0) * (range_.c1 - range_.c0) + c - range_.c0);
  }

  DepthCloud::CellRange range_;
  std::vector<char> own_;  // not bool: bytes are faster
};

}  // namespace quadmap
