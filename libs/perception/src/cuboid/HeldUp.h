#pragma once

#include "cuboid/FaceEstimator.h"

namespace quadmap
{
/** The bottom of an object that something else holds up above its support: detectors draw their box
 * around the panel of a screen, without the stand. It is where the cloud in the box ends, if the
 * box ends there as well and not where the object would meet its support, and nothing hides it.
 * What usually stands on floors is not held up (doc/mathematics.md, 8, "Held up").
 * \param standing All faces; the bottom is the support. \return Nothing of what stands on it. */
std::optional<FaceEstimate> heldUpBottom(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const Faces& standing,
    const LabelProperties& label,
    const PerceptionOptions& options);

}  // namespace quadmap
