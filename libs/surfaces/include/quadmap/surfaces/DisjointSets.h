#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace quadmap
{
/** Things (0, 1, ...) that are joined into sets, pair by pair. */
class DisjointSets
{
 public:
  explicit DisjointSets(std::size_t count) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /** The first member of a thing's set. */
  int firstOf(int i)
  {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }

  void join(int i, int j)
  {
    if (parent(i) == parent(j)) return;
    const int a = firstOf(i), b = firstOf(j);
    parent(std::max(a, b)) = std::min(a, b);
  }

  struct Numbers
  {
    int count = 0;        //!< Of the sets
    std::vector<int> of;  //!< Of each thing the number of its set, in the order of first members
  };
  Numbers numbers() const
  {
    Numbers out;
    out.of.reserve(parent_.size());
    for (const int parent : parent_)
    {
      const bool isFirst = parent == static_cast<int>(out.of.size());
      out.of.push_back(isFirst ? out.count++ : out.of[static_cast<std::size_t>(parent)]);
    }
    return out;
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<int> parent_;  // an earlier one of the same set; of the first one itself
};

}  // namespace quadmap
