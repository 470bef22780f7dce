#pragma once

#include "cuboid/UprightCloud.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** An object's heading in the frame `upright` of its cloud. */
struct HeadingEstimate
{
  double yaw = 0;        //!< [rad], one of the four directions of the faces
  double sigma = 0;      //!< [rad], when defined
  double dominance = 0;  //!< Share that agrees, of the normals or of a rim, in [0, 1]
  bool defined = false;
};

/** From the normals of vertical surfaces, refined by lines fitted to the faces; for a flat thing
 * whose normals say nothing (the frame of a screen) from the line it makes seen from above; else
 * from the smallest rectangle around the cloud, which is not `defined`. */
HeadingEstimate estimateHeading(const UprightCloud& cloud, const PerceptionOptions& options);

}  // namespace quadmap
