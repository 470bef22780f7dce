#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/relations/Inventory.h"

namespace quadmap
{
/** A row of a table of objects. */
struct ObjectRow
{
  const ObjectRecord* object = nullptr;
  std::optional<double> distance;  //!< From the place asked for [m]
};

/** For people: a line for each object, with its footprint below when asked for. What a list of
 * objects does not say is "-". */
std::string objectTable(const std::vector<ObjectRow>& rows, bool withFootprints);

/** The outline of an object's cuboid on the floor, as a line. */
std::string footprintText(const Ellipsoid& object);

/** Name, number of objects, labels and extent of a map, then the table of its objects.
 * \param seen When the objects were seen, as a line; empty when nobody knows. */
std::string mapSummary(
    const Inventory& inventory, const std::string& path, const std::string& seen);

/** A label is misspelt when neither the objects have it nor the label table.
 *  \exception std::runtime_error For such a label; names those that are spelt alike, and those of
 *  the objects. */
void requireLabel(const Inventory& inventory, const std::string& label, const std::string& path);

}  // namespace quadmap
