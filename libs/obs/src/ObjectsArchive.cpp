#include "ObjectsArchive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quadmap/base/ArchiveFields.h"

namespace quadmap
{
namespace
{
using mrpt::serialization::CArchive;

constexpr std::uint32_t kMaxImageSide = 65536;  // [px]
constexpr std::uint64_t kMaxDepthCells = 1u << 20;

/** Bits that say which optional parts follow. */
enum Part : std::uint8_t
{
  kMask = 1,
  kInstance = 2,
  kSeed = 4,
  kComplete = 8,
  kEdges = 16
};

std::uint8_t partsOf(const DetectedObject& o)
{
  return static_cast<std::uint8_t>(
      (o.mask ? kMask : 0) | (o.instanceId ? kInstance : 0) |
      (o.measurement.seed_sensor ? kSeed : 0) | (o.measurement.complete ? kComplete : 0) |
      (o.measurement.edges ? kEdges : 0));
}

void checkMaskSize(const ObjectMask& m)
{
  requireStored(
      m.width <= kMaxImageSide && m.height <= kMaxImageSide && m.x0 <= kMaxImageSide &&
          m.y0 <= kMaxImageSide &&
          std::uint64_t{m.width} * m.height <= CObservationObjects::kMostMaskPixels,
      "a mask is too large");
}

void writeMask(CArchive& out, const ObjectMask& m)
{
  checkMaskSize(m);
  requireStored(m.pixels.size() == std::size_t{m.width} * m.height, "a mask's size is wrong");
  for (const unsigned v : {m.x0, m.y0, m.width, m.height}) out.WriteAs<std::uint32_t>(v);
  std::uint32_t begin = 0;
  for (const auto end : m.pixels.runEnds()) writeVarint(out, end - std::exchange(begin, end));
  if (m.pixels.runEnds().empty()) writeVarint(out, 0);
}

/** \param left What the masks of the image may still have. */
ObjectMask readMask(CArchive& in, ObjectsBudget& left)
{
  ObjectMask m;
  for (unsigned* v : {&m.x0, &m.y0, &m.width, &m.height}) *v = readScalar<std::uint32_t>(in);
  checkMaskSize(m);
  const std::size_t size = std::size_t{m.width} * m.height;
  requireStored(size <= left.maskPixels, "the masks of an image are too large");
  left.maskPixels -= size;
  bool pixel = false;
  std::size_t run = readVarint(in);
  for (;; run = readVarint(in), pixel = !pixel)
  {
    requireStored(left.maskRuns-- > 0, "the masks of an image have too many runs of pixels");
    requireStored(run <= size - m.pixels.size(), "a mask has more pixels than its size");
    requireStored(run > 0 || m.pixels.size() == 0, "a mask has an empty run");
    m.pixels.append(static_cast<std::uint32_t>(run), pixel);
    if (m.pixels.size() == size) return m;
  }
}

void writeComplete(CArchive& out, const CompleteMeasurement& c)
{
  writePose(out, c.object_sensor.pose());
  writeVector(out, c.object_sensor.semiAxes());
  for (const auto& face : c.faces) out << static_cast<std::uint8_t>(face.kind) << face.sigma;
  out << c.yawDefined << c.yawSigma << c.yawDominance;
}

CompleteMeasurement readComplete(CArchive& in)
{
  CompleteMeasurement c;
  const auto pose = readPose(in);
  c.object_sensor = Ellipsoid(pose, readVector(in));
  for (auto& face : c.faces)
  {
    face.kind = readEnum(in, FaceKind::AtLeast, "the kind of a face");
    face.sigma = readScalar<double>(in);
  }
  c.yawDefined = readBool(in);
  c.yawSigma = readScalar<double>(in);
  c.yawDominance = readScalar<double>(in);
  return c;
}

void writeMeasurement(CArchive& out, const ObjectMeasurement& m)
{
  out << static_cast<std::uint8_t>(m.kind);
  writeText(out, m.reason);
  out << m.projectedIoU << m.depthCoverage;
  if (m.seed_sensor) writeVector(out, *m.seed_sensor);
  if (m.complete) writeComplete(out, *m.complete);
  if (!m.edges) return;
  for (const auto& edge : *m.edges)
  {
    writeVector(out, edge.plane_sensor.n);
    out << edge.plane_sensor.d << edge.sigmaAngle << static_cast<std::uint8_t>(edge.state);
  }
}

/** Takes the texts of an object off the bytes that they may have. */
void takeTexts(const DetectedObject& object, std::uint64_t& bytesLeft)
{
  const std::uint64_t bytes = object.label.size() + object.measurement.reason.size();
  requireStored(bytes <= bytesLeft, "the labels and reasons of an image are too long");
  bytesLeft -= bytes;
}

ObjectMeasurement readMeasurement(CArchive& in, std::uint8_t parts)
{
  ObjectMeasurement m;
  m.kind = readEnum(in, MeasurementKind::Rejected, "the kind of a measurement");
  m.reason = readText(in);
  m.projectedIoU = readScalar<double>(in);
  m.depthCoverage = readScalar<double>(in);
  if (parts & kSeed) m.seed_sensor = readVector(in);
  if (parts & kComplete) m.complete = readComplete(in);
  if (!(parts & kEdges)) return m;
  for (auto& edge : m.edges.emplace())
  {
    edge.plane_sensor.n = readVector(in);
    edge.plane_sensor.d = readScalar<double>(in);
    edge.sigmaAngle = readScalar<double>(in);
    edge.state = readEnum(in, EdgeState::Occluded, "the state of an edge");
  }
  return m;
}

bool isSigma(double sigma) { return sigma >= 0 && std::isfinite(sigma); }

}  // namespace

void writeCamera(CArchive& out, const mrpt::img::TCamera& camera)
{
  out << camera.ncols << camera.nrows;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out << camera.intrinsicParams(row, column);
  out << static_cast<std::uint8_t>(camera.distortion);
  for (const double d : camera.dist) out << d;
  out << camera.focalLengthMeters;
  writeText(out, camera.cameraName);
}

mrpt::img::TCamera readCamera(CArchive& in)
{
  mrpt::img::TCamera camera;
  camera.ncols = readScalar<std::uint32_t>(in);
  camera.nrows = readScalar<std::uint32_t>(in);
  requireStored(
      camera.ncols <= kMaxImageSide && camera.nrows <= kMaxImageSide, "the image is too large");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      camera.intrinsicParams(row, column) = readScalar<double>(in);
  camera.distortion =
      readEnum(in, mrpt::img::DistortionModel::kannala_brandt, "the distortion model");
  for (double& d : camera.dist) d = readScalar<double>(in);
  camera.focalLengthMeters = readScalar<double>(in);
  camera.cameraName = readText(in);
  return camera;
}

void writeCoarseDepth(CArchive& out, const CoarseDepth& depth)
{
  const std::uint64_t cells = std::uint64_t{depth.columns} * depth.rows;
  requireStored(
      cells <= kMaxDepthCells && depth.depth.size() == cells, "the coarse depth's size is wrong");
  out.WriteAs<std::uint32_t>(depth.columns).WriteAs<std::uint32_t>(depth.rows);
  for (const float d : depth.depth) out << d;
}

CoarseDepth readCoarseDepth(CArchive& in)
{
  CoarseDepth depth;
  depth.columns = readScalar<std::uint32_t>(in);
  depth.rows = readScalar<std::uint32_t>(in);
  const std::uint64_t cells = std::uint64_t{depth.columns} * depth.rows;
  requireStored(cells <= kMaxDepthCells, "the coarse depth is too large");
  depth.depth.resize(cells);
  for (float& d : depth.depth) d = readScalar<float>(in);
  return depth;
}

void writeDetectedObject(CArchive& out, const DetectedObject& object, ObjectsBudget& left)
{
  checkMeasurement(object.measurement);
  takeTexts(object, left.textBytes);
  out << partsOf(object);
  writeText(out, object.label);
  out << object.score << object.box.x1 << object.box.y1 << object.box.x2 << object.box.y2;
  if (object.mask) writeMask(out, *object.mask);
  if (object.instanceId) out << *object.instanceId;
  writeMeasurement(out, object.measurement);
}

DetectedObject readDetectedObject(CArchive& in, ObjectsBudget& left)
{
  DetectedObject object;
  const auto parts = readScalar<std::uint8_t>(in);
  requireStored(parts < 2 * kEdges, "an object has unknown parts");
  object.label = readText(in);
  object.score = readScalar<double>(in);
  for (double* v : {&object.box.x1, &object.box.y1, &object.box.x2, &object.box.y2})
    *v = readScalar<double>(in);
  if (parts & kMask) object.mask = readMask(in, left);
  if (parts & kInstance) object.instanceId = readScalar<std::uint32_t>(in);
  object.measurement = readMeasurement(in, parts);
  takeTexts(object, left.textBytes);
  checkMeasurement(object.measurement);
  return object;
}

void checkMeasurement(const ObjectMeasurement& m)
{
  requireStored(
      m.complete.has_value() == (m.kind == MeasurementKind::Complete),
      "a measurement must have a cuboid exactly when it is complete");
  requireStored(
      m.edges || (m.kind != MeasurementKind::Complete && m.kind != MeasurementKind::Partial),
      "a complete or partial measurement must have its box edges");
  requireStored(
      std::isfinite(m.projectedIoU) && std::isfinite(m.depthCoverage),
      "a measurement's quality is not finite");
  requireStored(!m.seed_sensor || m.seed_sensor->allFinite(), "a measurement's seed is not finite");
  if (m.complete)
    requireStored(
        isSigma(m.complete->yawSigma) && isSigma(m.complete->yawDominance) &&
            std::all_of(
                m.complete->faces.begin(), m.complete->faces.end(),
                [](const FaceMeasurement& f) { return isSigma(f.sigma); }),
        "a sigma of a complete measurement is not finite and >= 0");
  if (m.edges)
    for (const auto& edge : *m.edges)
      requireStored(
          edge.plane_sensor.n.allFinite() && std::isfinite(edge.plane_sensor.d) &&
              isSigma(edge.sigmaAngle),
          "an edge plane of a measurement is not finite");
}

}  // namespace quadmap
