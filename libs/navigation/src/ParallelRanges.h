#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <vector>

namespace quadmap
{
/** Calls use(i) for i = 0 .. count - 1, the numbers in order on each of some threads. */
template <typename F>
void forEachInParallel(std::size_t count, std::size_t threads, const F& use)
{
  const std::size_t perThread = (count + threads - 1) / threads;
  const auto range = [&](std::size_t first)
  {
    const std::size_t end = std::min(count, first + perThread);
    for (std::size_t i = first; i < end; ++i) use(i);
  };
  std::vector<std::future<void>> others;
  for (std::size_t first = perThread; first < count; first += perThread)
    others.push_back(std::async(std::launch::async, range, first));
  range(0);
  for (auto& other : others) other.get();
}

}  // namespace quadmap
