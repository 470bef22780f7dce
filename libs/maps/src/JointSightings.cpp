#include "quadmap/maps/JointSightings.h"

#include <algorithm>
#include <iterator>

namespace quadmap
{
void JointSightings::add(const std::set<ObjectId>& seen)
{
  for (auto a = seen.begin(); a != seen.end(); ++a)
    for (auto b = std::next(a); b != seen.end(); ++b) ++images_[{*a, *b}];
}

unsigned JointSightings::images(ObjectId a, ObjectId b) const
{
  const auto found = images_.find(std::minmax(a, b));
  return found == images_.end() ? 0 : found->second;
}

unsigned JointSightings::twice(ObjectId id) const
{
  const auto found = twice_.find(id);
  return found == twice_.end() ? 0 : found->second;
}

bool JointSightings::areTwo(const MapObject& a, const MapObject& b, double maxShare) const
{
  const auto often = [&](unsigned images, unsigned ofAll)
  {
    constexpr unsigned kOnce = 1;
    return images > kOnce && images > maxShare * ofAll;
  };
  const unsigned together = images(a.id, b.id), before = twice(a.id) + twice(b.id);
  return often(together, std::min(a.observations(), b.observations())) ||
         often(together + before, std::max(a.observations(), b.observations()));
}

void JointSightings::merge(ObjectId kept, ObjectId absorbed)
{
  if (const unsigned both = images(kept, absorbed) + twice(absorbed)) twice_[kept] += both;
  twice_.erase(absorbed);
  const auto heirOf = [&](ObjectId id) { return id == absorbed ? kept : id; };
  std::map<std::pair<ObjectId, ObjectId>, unsigned> merged;
  for (const auto& [pair, count] : images_)
  {
    const ObjectId a = heirOf(pair.first), b = heirOf(pair.second);
    if (a != b) merged[std::minmax(a, b)] += count;
  }
  images_ = std::move(merged);
}

void JointSightings::remove(ObjectId id)
{
  twice_.erase(id);
  for (auto it = images_.begin(); it != images_.end();)
    it = it->first.first == id || it->first.second == id ? images_.erase(it) : std::next(it);
}

void JointSightings::clear()
{
  images_.clear();
  twice_.clear();
}

}  // namespace quadmap
