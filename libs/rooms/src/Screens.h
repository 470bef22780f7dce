#pragma once

#include "FurnitureKit.h"

namespace quadmap::simulator
{
/** \name Screens, which look along +x. Most of them give no depth but from their frames. */
/** @{ */
/** A screen on its stand, as one piece. Real detectors draw their box around the panel alone:
 * RoomBuilder::detach() makes the stand a thing of its own. */
struct StandingScreen
{
  SceneObject whole;
  std::size_t panelParts = 0;  //!< The first parts of it; the others are the stand
};
StandingScreen television(FurnitureKit& kit);   //!< On a foot, or on two feet
SceneObject wallTelevision(FurnitureKit& kit);  //!< Without a foot; its z = 0 is its lower edge
StandingScreen monitor(FurnitureKit& kit);
SceneObject laptop(FurnitureKit& kit);
/** @} */

}  // namespace quadmap::simulator
