#pragma once

#include <map>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** Has the objects of the continued map claim what the map and the run know together, (19.10): both
 * saw them in the same way, so that their errors are not independent. Of several objects of the run
 * with one heir the same holds, as one run's poses err alike.
 * \param given The map that is continued, as it was.
 * \param own The run's own map.
 * \param heirs Of the run's objects in `map`. */
void claimTogether(
    const CQuadricObjectMap& given,
    const CQuadricObjectMap& own,
    const std::map<ObjectId, ObjectId>& heirs,
    CQuadricObjectMap& map);

}  // namespace quadmap
