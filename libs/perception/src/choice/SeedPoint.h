#pragma once

#include <Eigen/Dense>
#include <optional>

#include "cloud/ObjectCloud.h"

namespace quadmap
{
/** A point about where the object is, on the ray through the middle of its box, optical frame [m]
 * (doc/mathematics.md, 10, "Seed"). Its depth is the median depth of the object's points, which may
 * be those of a plant's pot only. Without a cloud it is a depth in the box or around it. The little
 * depth in the box of a screen may be that of the wall behind, so the cloud of a screen counts only
 * when the measurement is complete. \param box Inside the image. */
std::optional<Eigen::Vector3d> seedOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object, bool isComplete);

/** Depth of an object's nearest part, but for a few stray points [m]. \param box Inside the image.
 */
std::optional<double> nearDepthOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object);

/** Most of the object's box is without depth: screens, glass. */
bool looksLikeScreen(const ObjectCloud& object);

}  // namespace quadmap
