#include "quadmap/estimation/ObjectView.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/geometry/Projection.h"
#include "quadmap/geometry/ViewAngles.h"

namespace quadmap
{
namespace
{
/** A cuboid leaning more than this is not an upright object: only its box edges are used. */
constexpr double kMaxTilt = 20.0 * M_PI / 180.0;
/** How far the unseen end of an axis may lie beyond what was seen, as a share of that size. */
constexpr double kUnseenShare = 0.35;
/** Smallest believable standard deviation of a face [m]. */
constexpr double kMinFaceSigma = 0.0006;
/** Range, with its standard deviation, of an object without any depth whose size is not known [m].
 */
constexpr double kBlindRange = 2.5, kBlindRangeSigma = 1.2;
/** Standard deviation of the logarithm of a range that follows from the size of a box, besides what
 * objects of a kind differ by: they are seen from their narrow and their broad side. */
constexpr double kAspectSpread = 0.2;

/** Standard deviation of a range [m] that follows from the size of a box. */
double sigmaBySize(double range, const LabelProperties& properties)
{
  if (!properties.known) return kBlindRangeSigma / kBlindRange * range;
  return range * std::hypot(properties.sizeSpread, kAspectSpread);
}

/** Standard deviation of a seed's position [m] for a mean size [m], doc/mathematics.md, (11.8).
 * They are fitted to simulated scenes, in which parts of most objects are hidden. */
constexpr double sigmaAlongRay(double meanWidth) { return 0.05 + 0.5 * meanWidth; }
constexpr double sigmaAcrossRay(double meanSize) { return 0.02 + 0.11 * meanSize; }

Eigen::Vector3d composed(const mrpt::poses::CPose3D& T, const Eigen::Vector3d& p)
{
  Eigen::Vector3d out;
  T.composePoint(p.x(), p.y(), p.z(), out.x(), out.y(), out.z());
  return out;
}

/** Turns the measured cuboid upright about its centre. The faces' sigmas are those of
 * doc/mathematics.md, (11.3). */
bool setCuboid(
    const CompleteMeasurement& m,
    const mrpt::poses::CPose3D& T_map_sensor,
    const PoseNoise& noise,
    ObjectView& view)
{
  const Ellipsoid object = m.object_sensor.transformed(T_map_sensor);
  const Eigen::Matrix3d R = object.rotation();
  if (R(2, 2) < std::cos(kMaxTilt)) return false;

  view.complete = true;
  view.center = object.center();
  view.halfSizes = object.semiAxes();
  view.yaw = std::atan2(R(1, 0), R(0, 0));
  view.yawDefined = m.yawDefined;
  view.yawSigma = std::hypot(m.yawSigma, noise.angle);
  const double range = (view.center - view.camera).norm();
  const double poseSigma = std::hypot(noise.position, range * noise.angle);
  view.faces = m.faces;
  for (auto& face : view.faces)
    face.sigma = std::hypot(std::max(face.sigma, kMinFaceSigma), poseSigma);
  return true;
}

/** Weakens each face that looks out over a box edge at the image border or behind an occluder, and
 * reaches it. Such a face ends where the view ends, and the object is at least that large. But that
 * an upper edge is hidden is told by how low the box is for its kind and by what touches it
 * anywhere, not by what was seen at this edge: there the ends that depth shows count. */
void weakenCutFaces(
    const std::array<EdgeMeasurement, 4>& edges,
    const mrpt::poses::CPose3D& T_map_sensor,
    ObjectView& view)
{
  constexpr double kReaches = 0.03;  // distance to the edge's plane as a share of the range
  const Ellipsoid cuboid(
      mrpt::poses::CPose3D(view.center.x(), view.center.y(), view.center.z(), view.yaw, 0, 0),
      view.halfSizes);
  const Eigen::Matrix<double, 3, 8> corners = cuboid.cuboidCorners();
  const double range = (view.center - view.camera).norm();
  const auto measured = view.faces;
  for (const auto& edge : edges)
  {
    if (edge.state == EdgeState::Usable) continue;
    const Plane plane = edge.plane_sensor.transformed(T_map_sensor);
    if (edge.state == EdgeState::Occluded && isUpperEdge(plane, Eigen::Vector3d::UnitZ())) continue;
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      const FaceKind kind = measured[f].kind;
      if (kind != FaceKind::Measured && kind != FaceKind::AtLeast) continue;
      if (!looksOver(plane, view.faceNormal(f))) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (Eigen::Index c = 0; c < 8; ++c)
        if (view.faceNormal(f).dot(corners.col(c)) > view.faceOffset(f) - 1e-6)
          nearest = std::min(nearest, plane.signedDistance(corners.col(c)));
      if (nearest >= kReaches * range) continue;
      view.faces[f].kind = FaceKind::AtLeast;
      // Where a part of the rim was seen, the object ends nearby.
      if (kind == FaceKind::AtLeast && edge.state == EdgeState::NearImageBorder)
        view.isCutByImage[f] = true;
    }
  }
}

struct BoundingEdges
{
  std::array<bool, 4> bounds = {};
  bool lower = true;  // the lower end of the box is that of the object
};

/** The edges that bound the object. When the lower end of the box is cut or hidden, the edges
 * beside it bound only what is seen of the object, which may be wider below. */
BoundingEdges boundingEdges(
    const std::array<EdgeMeasurement, 4>& edges, const mrpt::poses::CPose3D& T_map_sensor)
{
  BoundingEdges out;
  std::array<double, 4> upwards;  // of the normals, which look towards the object
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    out.bounds[i] = edges[i].state == EdgeState::Usable;
    upwards[i] = edges[i].plane_sensor.transformed(T_map_sensor).n.z();
  }
  const auto highest = std::max_element(upwards.begin(), upwards.end());
  const auto lower = static_cast<std::size_t>(highest - upwards.begin());
  out.lower = out.bounds[lower];
  if (!out.lower) out.bounds[(lower + 1) % 4] = out.bounds[(lower + 3) % 4] = false;
  return out;
}

/** Covariance of the cuboid's centre, which is half the sum of two opposite faces. Unseen faces may
 * lie further out. */
Eigen::Matrix3d cuboidCenterCovariance(const ObjectView& view)
{
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double variance = 0;
    for (std::size_t f = 2 * axis; f < 2 * axis + 2; ++f)
    {
      const double unseen =
          isEquality(view.faces[f].kind)
              ? 0.0
              : kUnseenShare * 2 * view.halfSizes[static_cast<Eigen::Index>(axis)];
      variance += 0.25 * (view.faces[f].sigma * view.faces[f].sigma + unseen * unseen);
    }
    const Eigen::Vector3d n = view.faceNormal(2 * axis);
    S += variance * n * n.transpose();
  }
  return S;
}

/** Where four usable edges alone say that an object is, doc/mathematics.md, (11.10) and (11.11). */
struct BlindPosition
{
  Eigen::Vector3d direction;  // from the camera, through the middle of the box
  double range, sigma;        // along it [m]
};

BlindPosition blindPosition(
    const std::vector<ObjectView::Edge>& edges, const LabelProperties& properties)
{
  const Eigen::Vector3d &left = edges[0].plane.n, &top = edges[1].plane.n,
                        &right = edges[2].plane.n, &bottom = edges[3].plane.n;
  // Two opposite tangent planes are halved by the one with the difference of their normals.
  Eigen::Vector3d direction = (left - right).cross(top - bottom).normalized();
  if (direction.dot(left + top + right + bottom) < 0) direction = -direction;
  if (!properties.known) return {direction, kBlindRange, sigmaBySize(kBlindRange, properties)};
  const double width = std::sqrt(properties.typicalSize.x() * properties.typicalSize.y());
  const double range = std::sqrt(
      rangeThatFills(width, left, right) * rangeThatFills(properties.typicalSize.z(), top, bottom));
  return {direction, range, sigmaBySize(range, properties)};
}

/** Position of a partial measurement: the seed, pushed inwards by half the smaller typical width,
 * as flat things are seen from their broad sides. Without a seed it is somewhere along the ray
 * through the box. The covariance is that of doc/mathematics.md, (11.7).
 * \param isLowerEndSeen Else what is seen may be the upper end of the object. */
void setPartialPosition(
    const DetectedObject& detected,
    const mrpt::poses::CPose3D& T_map_sensor,
    const LabelProperties& properties,
    bool isLowerEndSeen,
    ObjectView& view)
{
  const Eigen::Vector3d size = properties.typicalSize;
  view.halfSizes = 0.5 * size;

  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double alongRay = 0;
  if (const auto& seed = detected.measurement.seed_sensor; seed)
  {
    const Eigen::Vector3d onSurface = composed(T_map_sensor, *seed);
    direction = (onSurface - view.camera).normalized();
    view.center = onSurface + 0.5 * std::min(size.x(), size.y()) * direction;
    alongRay = sigmaAlongRay(0.5 * (size.x() + size.y()));
    view.wrongDepthSigma = sigmaBySize((view.center - view.camera).norm(), properties);
  }
  else
  {
    const BlindPosition blind = blindPosition(view.edges, properties);
    direction = blind.direction;
    view.center = view.camera + blind.range * direction;
    alongRay = blind.sigma;
  }
  const double turn = (view.center - view.camera).norm() * view.pose.angle;
  const double across = std::hypot(sigmaAcrossRay(size.mean()), view.pose.position, turn);
  const double along = std::hypot(alongRay, view.pose.position);
  view.centerCovariance = across * across * Eigen::Matrix3d::Identity() +
                          (along * along - across * across) * direction * direction.transpose();
  if (!isLowerEndSeen) view.centerCovariance(2, 2) += 0.25 * size.z() * size.z();
}

ObjectView::Edge placed(
    const EdgeMeasurement& edge, const mrpt::poses::CPose3D& T_map_sensor, const PoseNoise& noise)
{
  return {edge.plane_sensor.transformed(T_map_sensor), std::hypot(edge.sigmaAngle, noise.angle)};
}

}  // namespace

std::array<Eigen::Vector3d, kFaces> ObjectView::faceNormals() const
{
  const double c = std::cos(yaw), s = std::sin(yaw);
  const Eigen::Vector3d x(c, s, 0), y(-s, c, 0), z(0, 0, 1);
  return {x, -x, y, -y, z, -z};
}

std::vector<ObjectView::Edge> usableEdges(
    const ObjectMeasurement& measurement,
    const mrpt::poses::CPose3D& T_map_sensor,
    const PoseNoise& noise)
{
  std::vector<ObjectView::Edge> usable;
  if (!measurement.edges) return usable;
  for (const EdgeMeasurement& edge : *measurement.edges)
    if (edge.state == EdgeState::Usable) usable.push_back(placed(edge, T_map_sensor, noise));
  return usable;
}

std::optional<ObjectView> viewOf(
    const DetectedObject& detected,
    const mrpt::poses::CPose3D& T_map_sensor,
    const LabelProperties& properties,
    const PoseNoise& noise)
{
  const ObjectMeasurement& m = detected.measurement;
  if (m.kind != MeasurementKind::Complete && m.kind != MeasurementKind::Partial) return {};

  ObjectView view;
  view.label = properties.name;
  view.camera = composed(T_map_sensor, Eigen::Vector3d::Zero());
  view.pose = noise;
  BoundingEdges bounding;
  if (m.edges)
  {
    bounding = boundingEdges(*m.edges, T_map_sensor);
    for (std::size_t i = 0; i < m.edges->size(); ++i)
      if (bounding.bounds[i]) view.edges.push_back(placed((*m.edges)[i], T_map_sensor, noise));
  }

  if (m.kind == MeasurementKind::Complete && m.complete &&
      setCuboid(*m.complete, T_map_sensor, noise, view))
  {
    if (properties.dominantDirection && !view.yawDefined)
      view.faceExponent = properties.shapeExponent;
    if (m.edges) weakenCutFaces(*m.edges, T_map_sensor, view);
    view.centerCovariance = cuboidCenterCovariance(view);
  }
  else if (m.seed_sensor || view.edges.size() == 4)
    setPartialPosition(detected, T_map_sensor, properties, bounding.lower, view);
  else
    return {};
  return view;
}

}  // namespace quadmap
