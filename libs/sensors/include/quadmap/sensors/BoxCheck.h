#pragma once

#include <optional>
#include <string>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
/** The reason why a detector's box cannot be used, or nothing when it can. The reasons are numbers
 * that are not finite, no area, a place outside the image, or a score outside [0, 1]. A box that
 * only reaches over the border of the image can be used.
 *  \param width, height Size of the image [px]. */
std::optional<std::string> whyUnusable(
    const ImageBox& box, double score, unsigned width, unsigned height);

}  // namespace quadmap
