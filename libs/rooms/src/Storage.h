#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name What stands with its back to a wall. Shelves: the top, if it is low enough to stand things
 * on, then the compartments. */
/** @{ */
Furniture cabinet(FurnitureKit& kit);    //!< With doors or drawers, low or high
Furniture bookshelf(FurnitureKit& kit);  //!< Open compartments
Furniture nightstand(FurnitureKit& kit);
Furniture screenStand(FurnitureKit& kit);  //!< Low; a detector knows no name for some of them
Furniture refrigerator(FurnitureKit& kit);
Furniture oven(FurnitureKit& kit);
Furniture kitchenBlock(FurnitureKit& kit);  //!< Cupboards with a worktop
Furniture wallCupboard(FurnitureKit& kit);  //!< Its z = 0 is its lower side
/** @} */

}  // namespace quadmap::simulator
