#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name What is on walls or hangs. Each faces +x; x = 0 is the wall and z = 0 its lower edge. */
/** @{ */
SceneObject doorFrame(FurnitureKit& kit, double width, double height);  //!< No detector knows it
/** The leaf of a door. \param opening Its angle to the wall about the hinge at y = 0 [rad]. */
SceneObject doorLeaf(FurnitureKit& kit, double width, double height, double opening);
SceneObject window(FurnitureKit& kit);
SceneObject picture(FurnitureKit& kit);
SceneObject wallClock(FurnitureKit& kit);
SceneObject radiator(FurnitureKit& kit);  //!< No detector knows it; stands on the floor
/** A lamp below the ceiling; z = 0 is the ceiling. Its box is that of the shade: the cord up to the
 * ceiling is a thing of its own, which no detector knows. */
struct HangingLamp
{
  SceneObject shade, cord;
};
HangingLamp hangingLamp(FurnitureKit& kit, double length);  //!< \param length Down to its end [m]
/** @} */

SceneObject person(FurnitureKit& kit);  //!< Stands; faces +x

}  // namespace quadmap::simulator
