#pragma once

#include <cstddef>
#include <vector>

namespace quadmap
{
/** Neighbours in a sorted list. */
struct Window
{
  std::size_t first = 0, count = 0;

  /** Index of the window's median; of an even number the upper one. */
  std::size_t middle() const { return first + count / 2; }
};

/** The window of a width that holds most of the values, both of its ends included. Of several that
 * hold equally many it is the lowest. This is a robust mode: values that are far off do not move
 * it. \param sorted In ascending order; empty: the result holds nothing. \param width Largest
 * difference of two values of the window, in their unit, >= 0. */
Window densestWindow(const std::vector<double>& sorted, double width);

}  // namespace quadmap
