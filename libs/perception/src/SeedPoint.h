#pragma once

#include <Eigen/Dense>
#include <optional>

#include "ObjectCloud.h"

namespace quadmap
{
/** Where an object is, about: in the middle of its box, at the median depth of its points, which
 * may be those of a plant's pot only; without a cloud, at a depth in the box or around it. What
 * little depth a screen's box has may be that of the wall behind: its cloud counts only when it
 * makes the object. Optical frame [m]. \param box Inside the image. */
std::optional<Eigen::Vector3d> seedOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object, bool isComplete);

/** Depth of an object's nearest part, but for a few stray points [m]. \param box Inside the image.
 */
std::optional<double> nearDepthOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object);

/** Most of the object's box is without depth: screens, glass. */
bool looksLikeScreen(const ObjectCloud& object);

}  // namespace quadmap
