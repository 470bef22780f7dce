#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** The axis-aligned box of a solid's outline [px], as if the image had no border and nothing were
 * in front of the solid. Parts less than 1 cm in front of the camera plane do not count. The box of
 * a solid that reaches through this plane is therefore finite, but far larger than any image.
 * \param T_camera_prim Pose in the camera's frame, x forward, y left, z up.
 * \return Nothing when no part of the solid is in front of the camera. */
std::optional<ImageBox> outlineBox(
    const Primitive& solid, const mrpt::poses::CPose3D& T_camera_prim, const PinholeCamera& camera);

/** The box of the outline of all parts of an object. \param T_camera_obj As above. */
std::optional<ImageBox> outlineBox(
    const SceneObject& object,
    const mrpt::poses::CPose3D& T_camera_obj,
    const PinholeCamera& camera);

}  // namespace quadmap::simulator
