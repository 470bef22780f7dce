#pragma once

#include <optional>

#include "cloud/ObjectCloud.h"
#include "cuboid/FaceEstimator.h"
#include "quadmap/obs/ObjectMeasurement.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** These sensors do not measure half of the size of thinner things [m]. */
inline constexpr double kMinHalfSize = 0.008;

/** The cuboid between six faces, optical frame. */
Ellipsoid cuboidOf(const Faces& faces, const Eigen::Matrix3d& R_obj_optical);

/** The upright cuboid around an object's cloud, with what each face is worth (doc/mathematics.md,
 * 8). Its frame is the optical one (object_sensor must still be transformed).
 * \param object Not empty. */
CompleteMeasurement fitCuboid(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const LabelProperties& label,
    const PerceptionOptions& options);

}  // namespace quadmap
