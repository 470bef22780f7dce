#include "choice/ModelChoice.h"

#include <algorithm>

#include "cuboid/CuboidFit.h"
#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
/** The lower end of the cuboid raised to the lowest point that was seen of the object. */
Ellipsoid visiblePart(const Ellipsoid& cuboid, const ObjectCloud& object)
{
  const Eigen::Vector3d up = cuboid.rotation().col(2);
  double lowest = cuboid.semiAxes().z();
  for (const auto& p : object.points) lowest = std::min(lowest, up.dot(p - cuboid.center()));
  const double raise = 0.5 * (std::max(lowest, -cuboid.semiAxes().z()) + cuboid.semiAxes().z());
  Eigen::Vector3d semiAxes = cuboid.semiAxes();
  semiAxes.z() = std::max(kMinHalfSize, semiAxes.z() - raise);
  mrpt::poses::CPose3D pose = cuboid.pose();
  const Eigen::Vector3d center = cuboid.center() + up * raise;
  pose.x(center.x());
  pose.y(center.y());
  pose.z(center.z());
  return Ellipsoid(pose, semiAxes);
}

BoxFit fitToBox(
    const PinholeCamera& camera,
    const ImageBox& unclipped,
    const ImageBox& box,
    double edgeTolerance)
{
  const ImageBox projected = unclipped.clipped(camera.width, camera.height);
  const ImageBox detected = box.clipped(camera.width, camera.height);
  const auto towards = [&](double from, double to)
  { return from + std::clamp(to - from, -edgeTolerance, edgeTolerance); };
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

}  // namespace

BoxFit bestFit(
    const DepthCloud& cloud,
    const Ellipsoid& cuboid,
    const ObjectCloud& object,
    const ImageBox& box,
    double edgeTolerance)
{
  constexpr double kMinIoU = 0.5, kMalus = 0.1;
  const auto& camera = cloud.camera();
  BoxFit best;
  for (const Ellipsoid& shape : {cuboid, visiblePart(cuboid, object)})
    if (const auto projected = projectCuboidBox(camera, shape))
    {
      const BoxFit fit = fitToBox(camera, *projected, box, edgeTolerance);
      if (fit.tolerantIoU > best.tolerantIoU) best = fit;
    }
  const BoxFit outline = fitToBox(camera, boundsOf(cloud, object), box, edgeTolerance);
  if (best.tolerantIoU > kMinIoU)
    best.tolerantIoU = std::max(best.tolerantIoU, outline.tolerantIoU - kMalus);
  best.isSpanned = outline.tolerantIoU > kMinIoU;
  return best;
}

}  // namespace quadmap
