#pragma once

#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/DoubtfulObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** An object that can be asked for. */
struct InventoryItem
{
  ObjectRecord record;    //!< In the map frame, z up
  bool confirmed = true;  //!< The map reports it

  /** Not confirmed, or it exists with a probability below 0.9. */
  bool isDoubtful() const { return !confirmed || quadmap::isDoubtful(record); }

  /** It exists with a probability below 0.1: as sure as others exist, it does not. */
  bool isRefuted() const { return record.existence && *record.existence < 1 - kSureExistence; }
};

/** What there is: objects, and the labels they may be called by. A value of its own, which does not
 * follow the map it was made of. */
struct Inventory
{
  std::vector<InventoryItem> items;
  LabelTable labels;
};

/** All objects of a map by id, also those that are not confirmed.
 * \exception std::runtime_error If the map has no label table and the installed one cannot be read.
 */
Inventory inventoryOf(const CQuadricObjectMap& map);

/** The objects of a list, as of a truth, with the installed label table.
 * \exception std::runtime_error If that table cannot be read. */
Inventory inventoryOf(const std::vector<ObjectRecord>& objects);

/** Whether a path names a list in the form of objects.json: it ends in .json. */
bool isObjectList(const std::string& path);

/** What a path names: such a list, else a map as for readMap().
 * \exception std::runtime_error Names the file that cannot be read. */
Inventory readInventory(const std::string& path);

}  // namespace quadmap
