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

bool isObjectList(const std::string& path)
{
  return std::filesystem::path(path).extension() == ".json";
}

Inventory readInventory(const std::string& path)
{
  return isObjectList(path) ? inventoryOf(readObjectsJson(path)) : inventoryOf(readMap(path));
}

}  // namespace quadmap
