#pragma once

#include "cuboid/FaceEstimator.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** The back of a front that nobody saw from behind: what few points lie there tell nothing. A panel
 * that leans reaches farther back than its front by its thickness: the front covers some depth
 * itself, and the label gives the depth of an upright one. */
void openUnseenBacks(const FaceEstimator& estimator, const LabelProperties& label, Faces& faces);

}  // namespace quadmap
