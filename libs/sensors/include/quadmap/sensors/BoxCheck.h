#pragma once

#include <optional>
#include <string>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
/** Whether a corner of a box is farther away than ten times the image's size. Detectors draw boxes
 * beyond the image, but not as far as that.
 * \param width, height Size of the image [px]. */
bool isFarOutside(const ImageBox& box, unsigned width, unsigned height);

/** The reason why a detector's box cannot be used, or nothing when it can. The reasons are numbers
 * that are not finite, no area, a place outside the image, a corner far outside it, or a score
 * outside [0, 1]. A box that only reaches over the border of the image can be used.
 *  \param width, height Size of the image [px]. */
std::optional<std::string> whyUnusable(
    const ImageBox& box, double score, unsigned width, unsigned height);

}  // namespace quadmap
