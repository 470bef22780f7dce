#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** A thing that stands on tables and shelves. \param kind In [0, smallKinds()). */
SceneObject smallThing(FurnitureKit& kit, std::size_t kind);
std::size_t smallKinds();

/** \name Other things, by what they are. */
/** @{ */
SceneObject cup(FurnitureKit& kit);
SceneObject bottle(FurnitureKit& kit);
SceneObject bowl(FurnitureKit& kit);
SceneObject lyingBook(FurnitureKit& kit);
SceneObject standingBook(FurnitureKit& kit);
SceneObject keyboard(FurnitureKit& kit);
SceneObject computerMouse(FurnitureKit& kit);
SceneObject remote(FurnitureKit& kit);
SceneObject tableLamp(FurnitureKit& kit);
SceneObject tablePlant(FurnitureKit& kit);
SceneObject kitchenMachine(FurnitureKit& kit);  //!< Microwave or toaster
SceneObject printer(FurnitureKit& kit);
SceneObject computer(FurnitureKit& kit);
SceneObject floorPlant(FurnitureKit& kit);
SceneObject floorThing(FurnitureKit& kit);  //!< Suitcase, box, bag, bin, teddy bear or ball
/** @} */

}  // namespace quadmap::simulator
