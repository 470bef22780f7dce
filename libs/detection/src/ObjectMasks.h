#pragma once

#include <optional>

#include "Letterbox.h"
#include "heads/Head.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** The pixels of an object, from the prototypes of a network's masks and the coefficients of its
 * raw box: doc/mathematics.md, (21.3). \param prototypes coefficients x height x width, over the
 * whole input. \param box The object's box in pixels of the image, within it. \return Nothing when
 * no pixel is. */
std::optional<ObjectMask> objectMask(
    const Tensor& prototypes,
    const RawBox& rawBox,
    const ImageBox& box,
    const Placement& place,
    cv::Size input);

}  // namespace quadmap
