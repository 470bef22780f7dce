#pragma once

#include <cstdint>
#include <string>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** The name under which a user asks for a random room instead of an installed scene. */
constexpr const char* kRandomRoom = "random";

/** Draws a furnished room with a way through it, a depth sensor and a detector: another one for
 * each seed. It is a scene as others; nothing in it overlaps, and the camera stays on free floor.
 * \exception std::runtime_error If no room could be walked through, in many attempts. */
Scene randomRoom(std::uint64_t seed);

/** The scene file of which readScene() makes the same scene. \param scene As random rooms are: a
 * walk with a single camera. */
std::string sceneText(const Scene& scene);

}  // namespace quadmap::simulator
