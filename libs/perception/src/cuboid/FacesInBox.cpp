#include "cuboid/FacesInBox.h"

#include <algorithm>

#include "cloud/Precision.h"
#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
constexpr double kMaxTolerances = 3.0;  // that an edge may lie outside the cuboid, at most

}  // namespace

CompleteMeasurement weakenFacesInsideBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    double edgeTolerance,
    CompleteMeasurement complete)
{
  const auto unclipped = projectCuboidBox(camera, complete.object_sensor);
  if (!unclipped) return complete;
  const ImageBox projected = unclipped->clipped(camera.width, camera.height);
  const double gaps[4] = {
      projected.x1 - box.x1, projected.y1 - box.y1, box.x2 - projected.x2, box.y2 - projected.y2};
  const auto planes = boxEdgePlanes(camera, box);
  const Eigen::Matrix3d R = complete.object_sensor.rotation();
  for (std::size_t e = 0; e < 4; ++e)
  {
    const double size = e % 2 == 0 ? box.width() : box.height();
    if (gaps[e] < kMaxTolerances * edgeTolerance + kBoxErrorShare * size) continue;
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      const Eigen::Vector3d n = (f % 2 == 0 ? 1.0 : -1.0) * R.col(static_cast<Eigen::Index>(f / 2));
      FaceKind& kind = complete.faces[f].kind;
      if (kind == FaceKind::Measured && looksOver(planes[e], n)) kind = FaceKind::AtLeast;
    }
  }
  return complete;
}

}  // namespace quadmap
