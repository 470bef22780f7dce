#include "quadmap/perception/FramePerception.h"

#include <mrpt/core/format.h>

#include <algorithm>

#include "CuboidFit.h"
#include "EdgeMeasurements.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr unsigned kCoarseColumns = 32, kCoarseRows = 24;

Eigen::Vector3d toSensor(const Eigen::Vector3d& p_optical)
{
  return {p_optical.z(), -p_optical.x(), -p_optical.y()};
}
Eigen::Vector3d toOptical(const Eigen::Vector3d& p_sensor)
{
  return {-p_sensor.y(), -p_sensor.z(), p_sensor.x()};
}

std::optional<double> medianDepthIn(
    const DepthCloud& cloud, const ImageBox& box, const ImageBox& hole, double p)
{
  const auto range = cloud.cellsOf(box), excluded = cloud.cellsOf(hole);
  std::vector<double> depths;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c)
      if (cloud.valid(c, r) && !excluded.contains(c, r)) depths.push_back(cloud.depth(c, r));
  constexpr std::size_t kMinCells = 12;
  if (depths.size() < kMinCells) return {};
  return quantile(std::move(depths), p);
}

/** A surface point for an object whose cloud could not be cut out: the near part of the box's
 * middle; without depth there (screens), what surrounds the box. */
std::optional<Eigen::Vector3d> seedWithoutCloud(const DepthCloud& cloud, const ImageBox& box)
{
  const double w = 0.25 * box.width(), h = 0.25 * box.height();
  const ImageBox core = {box.x1 + w, box.y1 + h, box.x2 - w, box.y2 - h};
  const double ring = std::max(8.0, 0.1 * std::max(box.width(), box.height()));
  const ImageBox around = {box.x1 - ring, box.y1 - ring, box.x2 + ring, box.y2 + ring};
  auto depth = medianDepthIn(cloud, core, {}, 0.3);
  if (!depth) depth = medianDepthIn(cloud, around, box, 0.5);
  if (!depth) return {};
  return Eigen::Vector3d(cloud.camera().ray(box.centerX(), box.centerY()) * *depth);
}

Eigen::Vector3d medianPoint(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d out;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> values;
    for (const auto& p : points) values.push_back(p[axis]);
    out[axis] = median(std::move(values));
  }
  return out;
}

double nearDepthOf(const ObjectCloud& object)
{
  std::vector<double> depths;
  for (const auto& p : object.points) depths.push_back(p.z());
  return quantile(std::move(depths), 0.05);
}

/** The lower end of the cuboid raised to the lowest point that was seen of the object. */
Ellipsoid visiblePart(const Ellipsoid& cuboid, const ObjectCloud& object)
{
  const Eigen::Vector3d up = cuboid.rotation().col(2);
  double lowest = cuboid.semiAxes().z();
  for (const auto& p : object.points) lowest = std::min(lowest, up.dot(p - cuboid.center()));
  const double raise = 0.5 * (std::max(lowest, -cuboid.semiAxes().z()) + cuboid.semiAxes().z());
  constexpr double kMinHalfHeight = 0.008;  // [m]
  Eigen::Vector3d semiAxes = cuboid.semiAxes();
  semiAxes.z() = std::max(kMinHalfHeight, semiAxes.z() - raise);
  mrpt::poses::CPose3D pose = cuboid.pose();
  const Eigen::Vector3d center = cuboid.center() + up * raise;
  pose.x(center.x());
  pose.y(center.y());
  pose.z(center.z());
  return Ellipsoid(pose, semiAxes);
}

/** How well a cuboid explains the detector's box. */
struct BoxFit
{
  double iou = 0;          // p of doc/mathematics.md
  double tolerantIoU = 0;  // the same with box edges free to move by their standard deviation
};

BoxFit fitToBox(
    const PinholeCamera& camera, const ImageBox& unclipped, const ImageBox& box, double edgeSigma)
{
  const ImageBox projected = unclipped.clipped(camera.width, camera.height);
  const ImageBox detected = box.clipped(camera.width, camera.height);
  const auto towards = [&](double from, double to)
  { return from + std::clamp(to - from, -edgeSigma, edgeSigma); };
  const ImageBox moved = {
      towards(detected.x1, projected.x1), towards(detected.y1, projected.y1),
      towards(detected.x2, projected.x2), towards(detected.y2, projected.y2)};
  return {imageBoxIoU(projected, detected), imageBoxIoU(projected, moved)};
}

/** Box around the cells of a cloud [px]. */
ImageBox boundsOf(const DepthCloud& cloud, const ObjectCloud& object)
{
  ImageBox out = {1e9, 1e9, -1e9, -1e9};
  for (const auto& cell : object.cells)
  {
    const double u = cell.c * cloud.stride(), v = cell.r * cloud.stride();
    out = {std::min(out.x1, u), std::min(out.y1, v), std::max(out.x2, u), std::max(out.y2, v)};
  }
  return out;
}

/** p of a measured cuboid. An object whose lower part is hidden stands on its support all the same,
 * but its box shows only what is visible; and an L-shaped thing (a chair) leaves a corner of its
 * cuboid empty: of these views the one that fits the box best counts, the last one with a malus. */
BoxFit bestFit(
    const DepthCloud& cloud,
    const Ellipsoid& cuboid,
    const ObjectCloud& object,
    const ImageBox& box,
    double edgeSigma)
{
  constexpr double kMinCuboidIoU = 0.5, kMalus = 0.1;
  const auto& camera = cloud.camera();
  BoxFit best;
  for (const Ellipsoid& view : {cuboid, visiblePart(cuboid, object)})
    if (const auto projected = projectCuboidBox(camera, view))
    {
      const BoxFit fit = fitToBox(camera, *projected, box, edgeSigma);
      if (fit.tolerantIoU > best.tolerantIoU) best = fit;
    }
  const BoxFit outline = fitToBox(camera, boundsOf(cloud, object), box, edgeSigma);
  if (best.tolerantIoU > kMinCuboidIoU)
    best.tolerantIoU = std::max(best.tolerantIoU, outline.tolerantIoU - kMalus);
  return best;
}

}  // namespace

struct FramePerception::Impl
{
  PerceptionOptions options;
  LabelTable labels;

  ObjectMeasurement measureBox(
      const DepthCloud& cloud, const ScenePlanes& planes, const DetectedObject& detection) const;
  void tryComplete(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectCloud& object,
      const DetectedObject& detection,
      ObjectMeasurement& out) const;
};

void FramePerception::Impl::tryComplete(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const DetectedObject& detection,
    ObjectMeasurement& out) const
{
  CompleteMeasurement complete =
      fitCuboid(cloud, planes, object, labels.properties(detection.label), options);
  const BoxFit fit =
      bestFit(cloud, complete.object_sensor, object, detection.box, options.edgeSigma);
  out.projectedIoU = fit.iou;
  if (fit.tolerantIoU < options.minCompleteIoU)
    out.reason = mrpt::format("cuboid fits the box only by %.2f", fit.iou);
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
    const DepthCloud& cloud, const ScenePlanes& planes, const DetectedObject& detection) const
{
  ObjectMeasurement out;
  out.kind = MeasurementKind::Rejected;
  const ImageBox visible = detection.box.clipped(cloud.camera().width, cloud.camera().height);
  if (!detection.box.isValid() || !visible.isValid())
  {
    out.reason = detection.box.isValid() ? "box outside the image" : "box without area";
    return out;
  }
  const ObjectCloud object =
      segmentObject(cloud, planes, detection, labels.properties(detection.label), options);
  out.depthCoverage = object.coverage;

  EdgeContext context;
  if (object.support) context.support = planes.plane(*object.support).plane;
  std::optional<Eigen::Vector3d> seed;
  if (object.empty())
  {
    out.reason = object.coverage > 0 ? "no separate surface in the box" : "no depth in the box";
    seed = seedWithoutCloud(cloud, visible);
    if (seed) context.nearDepth = seed->z();
  }
  else
  {
    seed = medianPoint(object.points);
    context.nearDepth = nearDepthOf(object);
    tryComplete(cloud, planes, object, detection, out);
  }
  if (seed) out.seed_sensor = toSensor(*seed);

  auto edges = measureEdges(cloud, detection.box, context, options);
  int usable = 0;
  for (auto& edge : edges)
  {
    edge.plane_sensor = edge.plane_sensor.transformed(T_sensor_optical());
    usable += edge.state == EdgeState::Usable ? 1 : 0;
  }
  if (out.kind != MeasurementKind::Complete && usable > 0) out.kind = MeasurementKind::Partial;
  if (out.kind != MeasurementKind::Rejected) out.edges = edges;
  if (out.kind == MeasurementKind::Rejected) out.reason += ", and no usable box edge";
  return out;
}

FramePerception::FramePerception(const PerceptionOptions& options, const LabelTable& labels) :
    impl_(std::make_unique<Impl>(Impl{options, labels}))
{
}

FramePerception::~FramePerception() = default;

std::optional<Plane> FramePerception::measure(
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const std::optional<Eigen::Vector3d>& up_sensor,
    const std::optional<Plane>& knownFloor_sensor) const
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
  std::optional<Plane> knownFloor;
  if (knownFloor_sensor) knownFloor = knownFloor_sensor->transformed(-T_sensor_optical());
  const ScenePlanes planes =
      classifyPlanes(cloud, std::move(segmentation), *up, knownFloor, impl_->options);
  for (auto& object : boxes.objects) object.measurement = impl_->measureBox(cloud, planes, object);
  if (!planes.floorSeen) return {};
  return planes.plane(*planes.floor).plane.transformed(T_sensor_optical());
}

}  // namespace quadmap
