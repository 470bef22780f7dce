#include "quadmap/relations/Relations.h"

#include <iterator>
#include <optional>
#include <stdexcept>

#include "Geometry.h"

namespace quadmap
{
namespace
{
/** Where an object of the map is in its inventory. */
std::size_t indexOf(const CQuadricObjectMap& map, ObjectId id)
{
  const auto& objects = map.objects();
  const auto found = objects.find(id);
  if (found == objects.end())
    throw std::out_of_range("the map has no object " + std::to_string(id));
  return static_cast<std::size_t>(std::distance(objects.begin(), found));
}

}  // namespace

const char* textOf(RelationKind kind)
{
  switch (kind)
  {
    case RelationKind::On:
      return "on";
    case RelationKind::In:
      return "in";
    case RelationKind::Under:
      return "under";
    case RelationKind::NextTo:
      return "next to";
    case RelationKind::Near:
      return "near";
    case RelationKind::InFrontOf:
      return "in front of";
    case RelationKind::Behind:
      return "behind";
    case RelationKind::Between:
      return "between";
    case RelationKind::Nearest:
      return "nearest";
    case RelationKind::Farthest:
      return "farthest";
  }
  return "";
}

std::vector<Relation> relationsOf(const Inventory& inventory)
{
  const Geometry geometry(inventory);
  std::vector<Relation> relations;
  for (std::size_t i = 0; i < geometry.size(); ++i)
    for (std::size_t j = 0; j < geometry.size(); ++j)
    {
      const auto add = [&](RelationKind kind, const std::optional<double>& distance)
      {
        if (distance)
          relations.push_back(
              {kind, inventory.items[i].record.id, inventory.items[j].record.id, *distance});
      };
      add(RelationKind::On, geometry.on(i, j));
      add(RelationKind::In, geometry.in(i, j));
      if (i < j) add(RelationKind::NextTo, geometry.nextTo(i, j));
      add(RelationKind::InFrontOf, geometry.inFrontOf(i, j));
      add(RelationKind::Behind, geometry.behind(i, j));
    }
  return relations;
}

std::vector<Relation> relationsOf(const CQuadricObjectMap& map)
{
  return relationsOf(inventoryOf(map));
}

std::optional<Eigen::Vector2d> frontOf(const CQuadricObjectMap& map, ObjectId id)
{
  const std::size_t index = indexOf(map, id);
  const Eigen::Vector2d front = Geometry(inventoryOf(map)).frontOf(index);
  if (front.isZero()) return std::nullopt;
  return front;
}

std::optional<ObjectId> tableOf(const CQuadricObjectMap& map, ObjectId id)
{
  const std::size_t index = indexOf(map, id);
  const auto table = Geometry(inventoryOf(map)).tableOf(index);
  if (!table) return std::nullopt;
  return std::next(map.objects().begin(), static_cast<std::ptrdiff_t>(*table))->first;
}

}  // namespace quadmap
