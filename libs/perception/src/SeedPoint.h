#pragma once

#include <Eigen/Dense>
#include <optional>

#include "ObjectCloud.h"

namespace quadmap
{
/** A surface point for an object whose cloud could not be cut out: the near part of the box's
 * middle; without depth there (screens), what surrounds the box. Optical frame [m].
 * \param box Inside the image. */
std::optional<Eigen::Vector3d> seedWithoutCloud(const DepthCloud& cloud, const ImageBox& box);

/** The median of an object's points, axis by axis, optical frame [m]. \param object Not empty. */
Eigen::Vector3d seedOf(const ObjectCloud& object);

/** Depth of an object's nearest part, but for a few stray points [m]. \param object Not empty. */
double nearDepthOf(const ObjectCloud& object);

}  // namespace quadmap
