#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** A row of a table of objects. */
struct ObjectRow
{
  const MapObject* object = nullptr;
  std::optional<double> distance;  //!< From the place asked for [m]
};

/** For people: a line for each object, with its footprint below when asked for. */
std::string objectTable(
    const CQuadricObjectMap& map, const std::vector<ObjectRow>& rows, bool withFootprints);

/** Name, number of objects, labels and extent of a map, then the table of its objects. */
std::string mapSummary(const CQuadricObjectMap& map, const std::string& path);

/** A label is misspelt when neither the map's objects have it nor its label table.
 *  \exception std::runtime_error For such a label; lists those of the objects. */
void requireLabel(const CQuadricObjectMap& map, const std::string& label, const std::string& path);

}  // namespace quadmap
