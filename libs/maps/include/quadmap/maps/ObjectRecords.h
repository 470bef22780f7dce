#pragma once

#include "quadmap/estimation/MapObject.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** An object of a map in the form of objects.json, confirmed or not. */
ObjectRecord recordOf(const MapObject& object);

}  // namespace quadmap
