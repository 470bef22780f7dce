#pragma once

#include <cstdint>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
class FurnitureKit;

/** Furnishes the room: its walls and surfaces are drawn as well. Nothing overlaps. */
void furnishRoom(Scene& scene, FurnitureKit& kit);

/** The free floor and the way of the camera through it. \return False if the camera could not see
 * enough from there. */
bool planTour(Scene& scene, FurnitureKit& kit);

/** Adds a person who comes, walks about and goes again, away from the camera, whose way must be
 * planned. */
void addWalker(Scene& scene, FurnitureKit& kit);

/** Draws camera, depth sensor and detector. */
void drawSensors(SimulatorOptions& options, FurnitureKit& kit);

}  // namespace quadmap::simulator
