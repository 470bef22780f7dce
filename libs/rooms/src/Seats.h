#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name What one sits or lies on, in proportions and parts that differ from call to call. */
/** @{ */
SceneObject diningChair(FurnitureKit& kit);  //!< Four legs; back of boards, slats or cushion
SceneObject officeChair(FurnitureKit& kit);  //!< On a column with a star of five
SceneObject stool(FurnitureKit& kit);
SceneObject couch(FurnitureKit& kit);  //!< With or without arms, some with a long seat at one end
SceneObject armchair(FurnitureKit& kit);
SceneObject bed(FurnitureKit& kit);
/** @} */

}  // namespace quadmap::simulator
