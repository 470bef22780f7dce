#include "GivenPoses.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

CPose3D GivenPoses::addKeyframe(
    const CPose3D& T_odom_robot,
    const std::optional<mrpt::poses::CPose3DPDFGaussian>&,
    const CObservationObjects* boxes,
    SlamResult& result)
{
  if (boxes) insertIntoMap(*boxes, result.keyframes.size(), T_odom_robot, result);
  return T_odom_robot;
}

void GivenPoses::finish(const BoxesOf&, SlamResult& result) { consolidateMap(result); }

}  // namespace quadmap
