#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** The axis-aligned box of a solid's outline in an image without borders [px]: nothing stands in
 * front of it, nothing cuts it. What is less than 1 cm in front of the camera plane does not count;
 * the box of a solid that reaches through that plane is finite, but far larger than any image.
 * \param T_camera_prim Camera frame x forward, y left, z up.
 * \return Nothing when no part of it lies in front of the camera. */
std::optional<ImageBox> outlineBox(
    const Primitive& solid, const mrpt::poses::CPose3D& T_camera_prim, const PinholeCamera& camera);

/** The box of the outline of all parts of an object. */
std::optional<ImageBox> outlineBox(
    const SceneObject& object,
    const mrpt::poses::CPose3D& T_world_camera,
    const PinholeCamera& camera);

}  // namespace quadmap::simulator
