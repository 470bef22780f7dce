#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name Tables. The first shelf is the top, the others are below it. */
/** @{ */
Furniture diningTable(FurnitureKit& kit);  //!< Square or round; on legs, a column or boards
Furniture desk(FurnitureKit& kit);         //!< One sits at +x
Furniture coffeeTable(FurnitureKit& kit);  //!< Some with a board below, some of glass
/** @} */

}  // namespace quadmap::simulator
