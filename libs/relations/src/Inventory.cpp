#include "quadmap/relations/Inventory.h"

#include <filesystem>

#include "quadmap/maps/MapFile.h"
#include "quadmap/maps/ObjectRecords.h"

namespace quadmap
{
Inventory inventoryOf(const CQuadricObjectMap& map)
{
  Inventory inventory;
  inventory.labels = map.labels();
  for (const auto& [id, object] : map.objects())
    inventory.items.push_back({recordOf(object), object.confirmed});
  return inventory;
}

Inventory inventoryOf(const std::vector<ObjectRecord>& objects)
{
  Inventory inventory;
  inventory.labels = LabelTable::installed();
  for (const ObjectRecord& object : objects) inventory.items.push_back({object, true});
  return inventory;
}

Inventory readInventory(const std::string& path)
{
  if (std::filesystem::path(path).extension() == ".json") return inventoryOf(readObjectsJson(path));
  return inventoryOf(readMap(path));
}

}  // namespace quadmap
