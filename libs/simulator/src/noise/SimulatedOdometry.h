#pragma once

#include <mrpt/poses/CPose3D.h>

#include <vector>

#include "quadmap/simulator/RandomStream.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
/** Poses that drift away from the true ones. The first is the true one. */
std::vector<mrpt::poses::CPose3D> driftingOdometry(
    const std::vector<mrpt::poses::CPose3D>& T_world_robot,
    const OdometryOptions& options,
    RandomStream& random);

}  // namespace quadmap::simulator
