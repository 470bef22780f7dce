#include "Carriers.h"

#include <deque>
#include <map>

namespace quadmap
{
Carriers::Carriers(const Geometry& geometry) : geometry_(geometry), carriersOf_(geometry.size())
{
  for (std::size_t i = 0; i < geometry.size(); ++i)
    for (std::size_t k = 0; k < geometry.size(); ++k)
      if (geometry.on(i, k) || geometry.in(i, k)) carriersOf_[i].push_back(k);
}

std::optional<std::vector<std::size_t>> Carriers::way(
    std::size_t subject, std::size_t object, RelationKind kind) const
{
  std::map<std::size_t, std::size_t> cameFrom = {
      {subject, subject}
  };
  for (std::deque<std::size_t> open = {subject}; !open.empty(); open.pop_front())
  {
    const std::size_t i = open.front();
    if (kind == RelationKind::On ? geometry_.on(i, object) : geometry_.in(i, object))
    {
      std::vector<std::size_t> way = {object};
      for (std::size_t k = i; k != subject; k = cameFrom.at(k)) way.insert(way.begin(), k);
      return way;
    }
    for (const std::size_t k : carriersOf_[i])
      if (cameFrom.emplace(k, i).second) open.push_back(k);
  }
  return std::nullopt;
}

}  // namespace quadmap
