#include "choice/ScreenOutline.h"

#include <algorithm>
#include <cmath>

#include "cuboid/CuboidFit.h"
#include "cuboid/FaceSigmas.h"

namespace quadmap
{
namespace
{
/** The side of a cuboid that covers most of the image, when it was seen; sides are +x, -x, +y, -y.
 * Of a screen it is the front, also when the thin side is turned towards the camera more. */
std::optional<std::size_t> seenFront(const CompleteMeasurement& cuboid)
{
  const Eigen::Vector3d ray = cuboid.object_sensor.center().normalized();
  const Eigen::Vector3d away = cuboid.object_sensor.rotation().transpose() * ray;
  const Eigen::Vector3d size = cuboid.object_sensor.semiAxes();
  const bool isY = std::abs(away.y()) * size.x() > std::abs(away.x()) * size.y();
  const std::size_t front = isY ? (away.y() < 0 ? 2 : 3) : (away.x() < 0 ? 0 : 1);
  if (!cuboid.yawDefined || cuboid.faces[front].kind != FaceKind::Measured) return {};
  return front;
}

/** An upright rectangle: its middle and its half sizes. */
struct FrontRectangle
{
  Eigen::Vector3d middle;
  double halfWidth = 0, halfHeight = 0;
};

/** The rectangle on a plane that touches the four planes through the edges of a box, equation
 * (10.2). Each is as far from the middle as the rectangle reaches towards it, which is linear in
 * where the middle is and in the half sizes. */
std::optional<FrontRectangle> inscribed(
    const std::array<Plane, 4>& edges,
    const Eigen::Vector3d& onPlane,
    const Eigen::Vector3d& along,
    const Eigen::Vector3d& up)
{
  Eigen::Matrix4d A;
  Eigen::Vector4d b;
  for (Eigen::Index i = 0; i < 4; ++i)
  {
    const Eigen::Vector3d& n = edges[static_cast<std::size_t>(i)].n;
    A.row(i) << n.dot(along), n.dot(up), -std::abs(n.dot(along)), -std::abs(n.dot(up));
    b[i] = -n.dot(onPlane);
  }
  const Eigen::Vector4d x = A.fullPivLu().solve(b);
  if (!x.allFinite() || x[2] <= 0 || x[3] <= 0) return {};
  return FrontRectangle{onPlane + x[0] * along + x[1] * up, x[2], x[3]};
}

}  // namespace

std::optional<CompleteMeasurement> screenInBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    const LabelProperties& label,
    const CompleteMeasurement& cuboid)
{
  const auto front = seenFront(cuboid);
  if (!front) return {};
  const Ellipsoid& seen = cuboid.object_sensor;
  const auto depthAxis = static_cast<Eigen::Index>(*front / 2), widthAxis = 1 - depthAxis;
  const Eigen::Matrix3d R = seen.rotation();
  const Eigen::Vector3d n = (*front % 2 == 0 ? 1.0 : -1.0) * R.col(depthAxis);
  const auto rectangle = inscribed(
      boxEdgePlanes(camera, box), seen.center() + seen.semiAxes()[depthAxis] * n, R.col(widthAxis),
      R.col(2));
  if (!rectangle) return {};

  CompleteMeasurement out = cuboid;
  for (std::size_t f = 0; f < kFaces; ++f)
    if (f != *front) out.faces[f].kind = FaceKind::Unknown;
  Eigen::Vector3d semiAxes;
  semiAxes[depthAxis] = 0.5 * label.typicalSize.head<2>().minCoeff();
  semiAxes[widthAxis] = rectangle->halfWidth;
  semiAxes[2] = rectangle->halfHeight;
  const Eigen::Vector3d center = rectangle->middle - semiAxes[depthAxis] * n;
  mrpt::poses::CPose3D pose = seen.pose();
  pose.x(center.x());
  pose.y(center.y());
  pose.z(center.z());
  out.object_sensor = Ellipsoid(pose, semiAxes);
  return out;
}

std::optional<CompleteMeasurement> plateInBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    const WallDistance& onWall,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options)
{
  const Eigen::Vector3d along = up.cross(onWall.wall.n).normalized();
  Eigen::Matrix3d R;
  R << along.cross(up), along, up;  // x out of the wall
  const Eigen::Vector3d ray = camera.ray(box.centerX(), box.centerY());
  const Eigen::Vector3d onFront = ray * (onWall.distance - onWall.wall.d) / onWall.wall.n.dot(ray);
  const auto rectangle = inscribed(boxEdgePlanes(camera, box), onFront, along, up);
  if (!rectangle) return {};

  CompleteMeasurement out;
  out.yawDefined = true;
  out.yawSigma = onWall.headingSigma;
  const double sigma = surfaceSigma(onFront.z(), options);
  const Eigen::Vector3d semiAxes(
      std::max(kMinHalfSize, 0.5 * onWall.distance), rectangle->halfWidth, rectangle->halfHeight);
  out.faces[0] = {FaceKind::Measured, sigma};
  // What is thinner than what can be measured would end in the wall.
  out.faces[1] = {FaceKind::Measured, std::hypot(sigma, 2 * semiAxes.x() - onWall.distance)};
  const Eigen::Vector3d center = rectangle->middle - semiAxes.x() * R.col(0);
  out.object_sensor = Ellipsoid(
      mrpt::poses::CPose3D::FromRotationAndTranslation(
          mrpt::math::CMatrixDouble33(R), mrpt::math::TPoint3D(center.x(), center.y(), center.z())),
      semiAxes);
  return out;
}

}  // namespace quadmap
