#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name Screens, which look along +x. Most of them give no depth but from their frames. */
/** @{ */
SceneObject television(FurnitureKit& kit);      //!< On a foot, or on two feet
SceneObject wallTelevision(FurnitureKit& kit);  //!< Without a foot; its z = 0 is its lower edge
SceneObject monitor(FurnitureKit& kit);
SceneObject laptop(FurnitureKit& kit);
/** @} */

}  // namespace quadmap::simulator
