#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace quadmap
{
/** Leaves the items with the greatest values in their order. Of items with equal values the first
 * stay. \param valueOf Gives a number that is not NaN. \return How many were left out. */
template <typename Item, typename ValueOf>
std::size_t keepGreatest(std::vector<Item>& items, std::size_t most, const ValueOf& valueOf)
{
  if (items.size() <= most) return 0;
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return valueOf(items[a]) > valueOf(items[b]); });
  order.resize(most);
  std::sort(order.begin(), order.end());
  std::vector<Item> kept;
  kept.reserve(most);
  for (const std::size_t i : order) kept.push_back(std::move(items[i]));
  const std::size_t leftOut = items.size() - most;
  items = std::move(kept);
  return leftOut;
}

}  // namespace quadmap
