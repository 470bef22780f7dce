#include "quadmap/perception/FramePerception.h"

#include <mrpt/core/format.h>

#include "CuboidFit.h"
#include "EdgeMeasurements.h"
#include "FacesInBox.h"
#include "ModelChoice.h"
#include "SeedPoint.h"
#include "SupportChoice.h"
#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
constexpr unsigned kCoarseColumns = 32, kCoarseRows = 24;

/** Share of the box's outline across which an object may go on. On simulated frames six of ten
 * measurements beyond are wrong by more than four sigmas, below one of ten. */
constexpr double kMaxLeak = 0.2;

Eigen::Vector3d toSensor(const Eigen::Vector3d& p_optical)
{
  return {p_optical.z(), -p_optical.x(), -p_optical.y()};
}
Eigen::Vector3d toOptical(const Eigen::Vector3d& p_sensor)
{
  return {-p_sensor.y(), -p_sensor.z(), p_sensor.x()};
}

/** The boxes of a frame that are mostly without depth: screens, glass. */
std::vector<BoxAtDepth> screensOf(
    const DepthCloud& cloud,
    const std::vector<ObjectTask>& tasks,
    const std::vector<ObjectCloud>& objects)
{
  std::vector<BoxAtDepth> out;
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const ImageBox& box = tasks[i].detection->box;
    const ImageBox visible = box.clipped(cloud.camera().width, cloud.camera().height);
    if (!visible.isValid() || !looksLikeScreen(objects[i])) continue;
    if (const auto depth = nearDepthOf(cloud, visible, objects[i])) out.push_back({box, *depth});
  }
  return out;
}

}  // namespace

struct FramePerception::Impl
{
  PerceptionOptions options;
  LabelTable labels;

  std::vector<ObjectTask> tasksOf(
      const DepthCloud& cloud,
      ScenePlanes& planes,
      const std::vector<DetectedObject>& detections) const;
  ObjectMeasurement measureBox(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectTask& task,
      const ObjectCloud& object,
      const std::vector<BoxAtDepth>& screens) const;
  void tryComplete(
      const DepthCloud& cloud,
      const ObjectCloud& object,
      const ObjectTask& task,
      CompleteMeasurement complete,
      ObjectMeasurement& out) const;
  /** Takes the edges over and chooses between partial and rejected. */
  void setEdges(const std::array<EdgeMeasurement, 4>& edges, ObjectMeasurement& out) const;
};

std::vector<ObjectTask> FramePerception::Impl::tasksOf(
    const DepthCloud& cloud,
    ScenePlanes& planes,
    const std::vector<DetectedObject>& detections) const
{
  std::vector<ObjectTask> tasks;
  const auto supports = chooseSupports(cloud, planes, detections, labels, options);
  for (std::size_t i = 0; i < detections.size(); ++i)
    tasks.push_back({&detections[i], labels.properties(detections[i].label), supports[i].plane});
  return tasks;
}

void FramePerception::Impl::tryComplete(
    const DepthCloud& cloud,
    const ObjectCloud& object,
    const ObjectTask& task,
    CompleteMeasurement complete,
    ObjectMeasurement& out) const
{
  const ImageBox& box = task.detection->box;
  const double tolerance = options.edgeToleranceIn(cloud.camera().width);
  weakenFacesInsideBox(cloud.camera(), box, tolerance, complete);
  const BoxFit fit = bestFit(cloud, complete.object_sensor, object, box, tolerance);
  out.projectedIoU = fit.iou;
  if (fit.tolerantIoU < options.minCompleteIoU)
    out.reason = mrpt::format("cuboid fits the box only by %.2f", fit.iou);
  else if (object.leak > kMaxLeak)
    out.reason = "its surface goes on outside the box";
  else if (out.depthCoverage < options.minDepthCoverage)
    out.reason = mrpt::format("depth in only %.0f %% of the box", 100 * out.depthCoverage);
  else
  {
    out.kind = MeasurementKind::Complete;
    out.reason = "cuboid fits the box";
    complete.object_sensor = complete.object_sensor.transformed(T_sensor_optical());
    out.complete = complete;
  }
}

ObjectMeasurement FramePerception::Impl::measureBox(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const ObjectCloud& object,
    const std::vector<BoxAtDepth>& screens) const
{
  const DetectedObject& detection = *task.detection;
  ObjectMeasurement out;
  out.kind = MeasurementKind::Rejected;
  const ImageBox visible = detection.box.clipped(cloud.camera().width, cloud.camera().height);
  if (!detection.box.isValid() || !visible.isValid())
  {
    out.reason = detection.box.isValid() ? "box outside the image" : "box without area";
    return out;
  }
  out.depthCoverage = object.coverage;

  EdgeContext context{object, task.label, planes.up, 0, {}, screens};
  if (object.support) context.surfaces.push_back(planes.plane(*object.support).plane);
  if (planes.floor) context.surfaces.push_back(planes.plane(*planes.floor).plane);
  if (object.empty())
  {
    out.reason = object.coverage > 0 ? "no separate surface in the box" : "no depth in the box";
  }
  else
  {
    const CompleteMeasurement complete = fitCuboid(cloud, planes, object, task.label, options);
    context.cuboidBox = projectCuboidBox(cloud.camera(), complete.object_sensor);
    if (options.models == ObservationModels::Partial)
      out.reason = "complete models are switched off";
    else
      tryComplete(cloud, object, task, complete, out);
  }
  const auto seed = seedOf(cloud, visible, object, out.kind == MeasurementKind::Complete);
  if (seed) context.depth = seed->z();
  if (seed) out.seed_sensor = toSensor(*seed);
  setEdges(measureEdges(cloud, detection.box, context, options), out);
  return out;
}

void FramePerception::Impl::setEdges(
    const std::array<EdgeMeasurement, 4>& edges, ObjectMeasurement& out) const
{
  int usable = 0;
  for (const auto& edge : edges) usable += edge.state == EdgeState::Usable ? 1 : 0;
  if (out.kind != MeasurementKind::Complete)
  {
    if (options.models == ObservationModels::Complete)
      out.reason += ", and partial models are switched off";
    else if (usable == 0)
      out.reason += ", and no usable box edge";
    else
      out.kind = MeasurementKind::Partial;
  }
  if (out.kind != MeasurementKind::Rejected) out.edges = edges;
}

FramePerception::FramePerception(const PerceptionOptions& options, const LabelTable& labels) :
    impl_(std::make_unique<Impl>(Impl{options, labels}))
{
}

FramePerception::~FramePerception() = default;

FrameSurfaces FramePerception::measure(
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const std::optional<Eigen::Vector3d>& up_sensor,
    const std::vector<SurfacePatch>& known_sensor) const
{
  const DepthCloud cloud(scan, impl_->options);
  boxes.coarseDepth = cloud.coarse(kCoarseColumns, kCoarseRows);
  PlaneSegmentation segmentation = segmentPlanes(cloud, impl_->options);
  std::optional<Eigen::Vector3d> up;
  if (up_sensor)
    up = toOptical(*up_sensor);
  else
    up = upFromPlanes(cloud, segmentation.planes);
  if (!up)
  {
    for (auto& object : boxes.objects)
    {
      object.measurement = {};
      object.measurement.kind = MeasurementKind::Rejected;
      object.measurement.reason = "no up direction: neither a pose nor a plane in the frame";
    }
    return {};
  }
  std::vector<SurfacePatch> known;
  for (const auto& patch : known_sensor) known.push_back(transformed(patch, -T_sensor_optical()));
  ScenePlanes planes = classifyPlanes(cloud, std::move(segmentation), *up, known, impl_->options);
  const auto tasks = impl_->tasksOf(cloud, planes, boxes.objects);
  const auto objects = segmentObjects(cloud, planes, tasks, impl_->options);
  const auto screens = screensOf(cloud, tasks, objects);
  for (std::size_t i = 0; i < tasks.size(); ++i)
    boxes.objects[i].measurement = impl_->measureBox(cloud, planes, tasks[i], objects[i], screens);

  FrameSurfaces out = surfacesOf(cloud, planes);
  for (auto& patch : out.seen) patch = transformed(patch, T_sensor_optical());
  for (auto& p : out.seenThrough) p = transformed(p, T_sensor_optical());
  return out;
}

}  // namespace quadmap
