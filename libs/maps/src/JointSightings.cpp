#include "quadmap/maps/JointSightings.h"

#include <algorithm>

namespace quadmap
{
void JointSightings::add(const std::set<ObjectId>& seen)
{
  for (const ObjectId a : seen)
    for (const ObjectId b : seen)
      if (a != b) ++pairs_[a][b];
}

unsigned JointSightings::pairs(ObjectId a, ObjectId b) const
{
  const auto ofA = pairs_.find(a);
  if (ofA == pairs_.end()) return 0;
  const auto found = ofA->second.find(b);
  return found == ofA->second.end() ? 0 : found->second;
}

unsigned JointSightings::pairsWithMerged(ObjectId id) const
{
  const auto found = pairsWithMerged_.find(id);
  return found == pairsWithMerged_.end() ? 0 : found->second;
}

bool JointSightings::showTwoThings(const MapObject& a, const MapObject& b, double maxShare) const
{
  // By chance a detector draws two boxes for one thing in a few images in a row. What these start
  // has hardly any other boxes.
  constexpr unsigned kFew = 3, kOnce = 1;
  const unsigned together = pairs(a.id, b.id);
  if (together == 0) return false;
  const unsigned all = together + pairsWithMerged(a.id) + pairsWithMerged(b.id);
  const auto [less, more] = std::minmax({a.observations(), b.observations()});
  const bool beside = together > kFew && together > maxShare * less;  // (13.6)
  return beside || (all > kOnce && all > maxShare * more);            // (13.7)
}

void JointSightings::merge(ObjectId kept, ObjectId absorbed)
{
  if (const unsigned both = pairs(kept, absorbed) + pairsWithMerged(absorbed))
    pairsWithMerged_[kept] += both;
  if (const auto found = pairs_.find(absorbed); found != pairs_.end())
    for (const auto& [other, count] : found->second)
      if (other != kept)
      {
        pairs_[kept][other] += count;
        pairs_[other][kept] += count;
      }
  remove(absorbed);
}

void JointSightings::remove(ObjectId id)
{
  pairsWithMerged_.erase(id);
  if (const auto found = pairs_.find(id); found != pairs_.end())
  {
    for (const auto& partner : found->second) pairs_[partner.first].erase(id);
    pairs_.erase(found);
  }
}

void JointSightings::clear()
{
  pairs_.clear();
  pairsWithMerged_.clear();
}

}  // namespace quadmap
