#pragma once

#include <optional>
#include <string>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
/** Why nobody can use a detector's box: numbers that are not finite, no area, outside the image, a
 * score outside [0, 1]. A box that only reaches over the image's border is usable.
 *  \param width, height Of the image [px]. */
std::optional<std::string> whyUnusable(
    const ImageBox& box, double score, unsigned width, unsigned height);

}  // namespace quadmap
