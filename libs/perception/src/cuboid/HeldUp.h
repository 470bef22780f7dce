#pragma once

#include "cuboid/FaceEstimator.h"

namespace quadmap
{
/** The bottom of an object that something else holds up above its support: detectors draw their box
 * around the panel of a screen, without the stand. It is where the cloud in the box ends clear of
 * the support, if the box ends there as well. Where the cloud reaches the support, as it does when
 * the box shows a foot, it is where the box ends, if that is too soon for what stands. What usually
 * stands on floors, and what something hides, is not held up (doc/mathematics.md, (8.12)).
 * \param standing All faces, with the support at the bottom where one is known. \return Nothing of
 * what stands. */
std::optional<FaceEstimate> heldUpBottom(
    const PinholeCamera& camera,
    const FaceEstimator& estimator,
    const Faces& standing,
    const LabelProperties& label,
    const PerceptionOptions& options);

}  // namespace quadmap
