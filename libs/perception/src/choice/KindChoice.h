#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>

#include "cloud/ObjectCloud.h"
#include "quadmap/obs/ObjectMeasurement.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** Says whether the cuboid of an object makes a complete measurement, and why. */
struct CuboidVerdict
{
  std::optional<CompleteMeasurement> complete;  //!< Sensor frame; nothing when it does not count
  double projectedIoU = 0;                      //!< p of equation (10.1)
  std::string reason;
};

/** Compares the cuboid with its box (doc/mathematics.md, 10, "Fit"). Where it does not count, what
 * hangs on a wall may be a flat thing there ("Flat on a wall"). \param cuboid Optical frame;
 * nothing when the box has no cloud. \param up Unit vector, optical frame. */
CuboidVerdict judgeCuboid(
    const DepthCloud& cloud,
    const ObjectTask& task,
    const ObjectCloud& object,
    const std::optional<CompleteMeasurement>& cuboid,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options);

/** Makes the measurement of a box: complete, partial or rejected (doc/mathematics.md, 10,
 * "Choice"). \param seed_sensor A point of the object's surface [m], if any is known. */
ObjectMeasurement chooseKind(
    const CuboidVerdict& verdict,
    const ObjectCloud& object,
    const std::optional<Eigen::Vector3d>& seed_sensor,
    const std::array<EdgeMeasurement, 4>& edges,
    const PerceptionOptions& options);

}  // namespace quadmap
