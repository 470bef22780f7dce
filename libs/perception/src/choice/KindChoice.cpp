#include "choice/KindChoice.h"

#include <mrpt/core/format.h>

#include <algorithm>

#include "choice/ModelChoice.h"
#include "choice/ScreenOutline.h"
#include "choice/SeedPoint.h"
#include "cuboid/FacesInBox.h"
#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
/** Share of the box's outline across which an object may go on. On simulated frames six of ten
 * measurements beyond it are wrong by more than four sigmas, and below it one of ten. */
constexpr double kMaxLeak = 0.2;

/** As judgeCuboid(), of the cuboid alone and in the optical frame. */
CuboidVerdict judgeOwnCuboid(
    const DepthCloud& cloud,
    const ObjectTask& task,
    const ObjectCloud& object,
    const std::optional<CompleteMeasurement>& cuboid,
    const PerceptionOptions& options)
{
  CuboidVerdict out;
  if (!cuboid)
  {
    out.reason = object.coverage > 0 ? "no separate surface in the box" : "no depth in the box";
    return out;
  }
  if (options.models == ObservationModels::Partial)
  {
    out.reason = "complete models are switched off";
    return out;
  }
  const ImageBox& box = task.detection->box;
  const double tolerance = options.edgeToleranceIn(cloud.camera().width);
  const BoxFit fit = bestFit(cloud, cuboid->object_sensor, object, box, tolerance);  // (10.1)
  out.projectedIoU = fit.iou;
  const bool fits = fit.tolerantIoU >= options.minCompleteIoU;
  if (object.leak > kMaxLeak)
    out.reason = "its surface goes on outside the box";
  else if (looksLikeScreen(object) && !fits && (fit.isSpanned || task.wall))
  {
    out.complete = screenInBox(cloud.camera(), box, task.label, *cuboid);
    out.reason = out.complete ? "screen on its front" : "no front of a screen in the box";
  }
  else if (!fits)
    out.reason = mrpt::format("cuboid fits the box only by %.2f", fit.iou);
  else if (object.coverage < options.minDepthCoverage)
    out.reason = mrpt::format("depth in only %.0f %% of the box", 100 * object.coverage);
  else
  {
    out.reason = "cuboid fits the box";
    out.complete = weakenFacesInsideBox(cloud.camera(), box, tolerance, *cuboid);
  }
  return out;
}
}  // namespace

CuboidVerdict judgeCuboid(
    const DepthCloud& cloud,
    const ObjectTask& task,
    const ObjectCloud& object,
    const std::optional<CompleteMeasurement>& cuboid,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options)
{
  CuboidVerdict out = judgeOwnCuboid(cloud, task, object, cuboid, options);
  if (!out.complete && object.onWall && options.models != ObservationModels::Partial)
  {
    out.complete = plateInBox(cloud.camera(), task.detection->box, *object.onWall, up, options);
    if (out.complete) out.reason = "flat on its wall";
  }
  if (out.complete)
    out.complete->object_sensor = out.complete->object_sensor.transformed(T_sensor_optical());
  return out;
}

ObjectMeasurement chooseKind(
    const CuboidVerdict& verdict,
    const ObjectCloud& object,
    const std::optional<Eigen::Vector3d>& seed_sensor,
    const std::array<EdgeMeasurement, 4>& edges,
    const PerceptionOptions& options)
{
  ObjectMeasurement out;
  out.kind = MeasurementKind::Rejected;
  out.reason = verdict.reason;
  out.depthCoverage = object.coverage;
  out.projectedIoU = verdict.projectedIoU;
  out.seed_sensor = seed_sensor;
  const bool hasUsableEdge = std::any_of(
      edges.begin(), edges.end(),
      [](const EdgeMeasurement& edge) { return edge.state == EdgeState::Usable; });
  if (verdict.complete)
  {
    out.kind = MeasurementKind::Complete;
    out.complete = verdict.complete;
  }
  else if (options.models == ObservationModels::Complete)
    out.reason += ", and partial models are switched off";
  else if (!hasUsableEdge)
    out.reason += ", and no usable box edge";
  else
    out.kind = MeasurementKind::Partial;
  if (out.kind != MeasurementKind::Rejected) out.edges = edges;
  return out;
}

}  // namespace quadmap
