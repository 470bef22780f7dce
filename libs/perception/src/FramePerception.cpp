#include "quadmap/perception/FramePerception.h"

#include <string>
#include <utility>

#include "choice/KindChoice.h"
#include "choice/SeedPoint.h"
#include "cuboid/CuboidFit.h"
#include "edges/EdgeMeasurements.h"
#include "quadmap/geometry/Projection.h"
#include "support/SupportChoice.h"

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
std::vector<SurfacePatch> toOptical(const std::vector<SurfacePatch>& patches_sensor)
{
  std::vector<SurfacePatch> out;
  for (const auto& patch : patches_sensor) out.push_back(transformed(patch, -T_sensor_optical()));
  return out;
}
FrameSurfaces toSensor(const FrameSurfaces& surfaces_optical)
{
  FrameSurfaces out;
  for (const auto& patch : surfaces_optical.seen)
    out.seen.push_back(transformed(patch, T_sensor_optical()));
  for (const auto& p : surfaces_optical.seenThrough)
    out.seenThrough.push_back(transformed(p, T_sensor_optical()));
  out.contradictsFloor = surfaces_optical.contradictsFloor;
  return out;
}

/** The up direction of the frame, in the optical frame: from the pose when there is one, else from
 * the planes. */
std::optional<Eigen::Vector3d> upOf(
    const DepthCloud& cloud,
    const PlaneSegmentation& pieces,
    const std::optional<Eigen::Vector3d>& up_sensor)
{
  if (up_sensor) return toOptical(*up_sensor);
  return upFromPlanes(cloud, pieces.planes);
}

/** The part of a box inside the image; nothing when there is none. */
std::optional<ImageBox> insideImage(const DepthCloud& cloud, const ImageBox& box)
{
  const ImageBox visible = box.clipped(cloud.camera().width, cloud.camera().height);
  if (!box.isValid() || !visible.isValid()) return {};
  return visible;
}

/** Puts together what is known of each box before its object is cut out. */
std::vector<ObjectTask> tasksOf(
    const std::vector<DetectedObject>& detections,
    const std::vector<BoxSupport>& supports,
    const LabelTable& labels)
{
  std::vector<ObjectTask> tasks;
  for (std::size_t i = 0; i < detections.size(); ++i)
    tasks.push_back(
        {&detections[i], labels.properties(detections[i].label), supports[i].plane,
         supports[i].wall});
  return tasks;
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
    const auto visible = insideImage(cloud, box);
    if (!visible || !looksLikeScreen(objects[i])) continue;
    if (const auto depth = nearDepthOf(cloud, *visible, objects[i])) out.push_back({box, *depth});
  }
  return out;
}

ObjectMeasurement rejected(const std::string& reason)
{
  ObjectMeasurement out;
  out.kind = MeasurementKind::Rejected;
  out.reason = reason;
  return out;
}

}  // namespace

struct FramePerception::Impl
{
  PerceptionOptions configured;
  LabelTable labels;

  struct Result
  {
    CoarseDepth coarseDepth;
    std::vector<ObjectMeasurement> boxes;              // one for each detection
    std::vector<std::optional<BoxEvidence>> evidence;  // of their edges, where there are any
    FrameSurfaces surfaces;                            // sensor frame
  };

  /** The algorithm, step by step. The numbers are those of the sections of doc/mathematics.md. */
  Result measure(
      const mrpt::obs::CObservation3DRangeScan& scan,
      const std::vector<DetectedObject>& detections,
      const std::optional<Eigen::Vector3d>& up_sensor,
      const std::vector<SurfacePatch>& known_sensor) const;

  struct MeasuredBox
  {
    ObjectMeasurement measurement;
    std::optional<BoxEvidence> evidence;
  };

  /** The steps for one box. */
  MeasuredBox measureBox(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectTask& task,
      const ObjectCloud& object,
      const std::vector<BoxAtDepth>& screens,
      const PerceptionOptions& options) const;
};

auto FramePerception::Impl::measure(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const std::vector<DetectedObject>& detections,
    const std::optional<Eigen::Vector3d>& up_sensor,
    const std::vector<SurfacePatch>& known_sensor) const -> Result
{
  Result out;
  // 4 Depth noise (4.1) - (4.3)
  const DepthCloud cloud(scan, configured);
  PerceptionOptions options = configured;
  options.depthNoise = cloud.noise();
  options.maxDepthNoiseFactor = 1;
  out.coarseDepth = cloud.coarse(kCoarseColumns, kCoarseRows);
  // 5 Planes: pieces (5.1), up and floor, main heights (5.2), known surfaces
  auto pieces = segmentPlanes(cloud, options);
  const auto up = upOf(cloud, pieces, up_sensor);
  if (!up)
  {
    out.boxes.assign(
        detections.size(), rejected("no up direction: neither a pose nor a plane in the frame"));
    out.evidence.resize(detections.size());
    return out;
  }
  auto planes = classifyPlanes(cloud, std::move(pieces), *up, toOptical(known_sensor), options);
  // 6 What the objects stand on (6.1) - (6.3)
  const auto scene = chooseSupports(cloud, std::move(planes), detections, labels, options);
  out.surfaces = toSensor(surfacesOf(cloud, scene.planes));
  const auto tasks = tasksOf(detections, scene.supports, labels);
  // 7 The objects' clouds (7.1) - (7.4)
  const auto objects = segmentObjects(cloud, scene.planes, tasks, options);
  const auto screens = screensOf(cloud, tasks, objects);
  // 8 Cuboid, 9 Edges, 10 Choice and seed
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    auto box = measureBox(cloud, scene.planes, tasks[i], objects[i], screens, options);
    out.boxes.push_back(std::move(box.measurement));
    out.evidence.push_back(box.evidence);
  }
  return out;
}

auto FramePerception::Impl::measureBox(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const ObjectCloud& object,
    const std::vector<BoxAtDepth>& screens,
    const PerceptionOptions& options) const -> MeasuredBox
{
  const ImageBox& box = task.detection->box;
  const auto visible = insideImage(cloud, box);
  if (!visible) return {rejected(box.isValid() ? "box outside the image" : "box without area"), {}};
  // 8 The cuboid: heading (8.1) - (8.5), faces (8.6) - (8.12)
  std::optional<CompleteMeasurement> cuboid;
  if (!object.empty()) cuboid = fitCuboid(cloud, planes, object, task.label, options);
  // 10 Choice: fit of the cuboid (10.1)
  const auto verdict = judgeCuboid(cloud, task, object, cuboid, planes.up, options);
  // 10 Seed
  const auto seed = seedOf(cloud, *visible, object, verdict.complete.has_value());
  // 9 Edges (9.1) - (9.5)
  EdgeContext context{object, task.label, planes.up, seed ? seed->z() : 0, screens, {}};
  if (cuboid) context.cuboidBox = projectCuboidBox(cloud.camera(), cuboid->object_sensor);
  const auto judged = measureEdges(cloud, box, context, options);
  // 10 Choice
  std::optional<Eigen::Vector3d> seed_sensor;
  if (seed) seed_sensor = toSensor(*seed);
  return {chooseKind(verdict, object, seed_sensor, judged.edges, options), judged.evidence};
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
  auto result = impl_->measure(scan, boxes.objects, up_sensor, known_sensor);
  boxes.coarseDepth = std::move(result.coarseDepth);
  for (std::size_t i = 0; i < boxes.objects.size(); ++i)
    boxes.objects[i].measurement = std::move(result.boxes[i]);
  return std::move(result.surfaces);
}

std::vector<std::optional<BoxEvidence>> FramePerception::edgeEvidence(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const CObservationObjects& boxes,
    const std::optional<Eigen::Vector3d>& up_sensor,
    const std::vector<SurfacePatch>& known_sensor) const
{
  return impl_->measure(scan, boxes.objects, up_sensor, known_sensor).evidence;
}

}  // namespace quadmap
