#include "cuboid/UprightCloud.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
Eigen::Matrix3d uprightRotation(const Eigen::Vector3d& up, const Eigen::Vector3d& towards)
{
  Eigen::Vector3d x = towards - up * up.dot(towards);
  if (x.norm() < 1e-3) x = up.unitOrthogonal();  // seen from exactly above
  x.normalize();
  Eigen::Matrix3d R;
  R.row(0) = x;
  R.row(1) = up.cross(x);
  R.row(2) = up;
  return R;
}

}  // namespace

UprightCloud uprightCloud(
    const DepthCloud& cloud, const ObjectCloud& object, const Eigen::Vector3d& up_optical)
{
  UprightCloud out;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const auto& p : object.points) centroid += p;
  out.R_upright_optical = uprightRotation(up_optical, centroid.normalized());
  out.medianRange = median(sampleOf(object.points, 2));
  constexpr std::size_t kMaxSamples = 1600;
  const std::size_t step = 1 + object.points.size() / kMaxSamples;
  out.cellsPerSample = static_cast<double>(step) * object.step * object.step;
  out.cellsPerNormal = cloud.cellsPerNormal(out.medianRange);
  const std::size_t samples = object.points.size() / step + 1;
  out.cells.reserve(samples);
  out.points.reserve(samples);
  out.normals.reserve(samples);
  for (std::size_t i = 0; i < object.points.size(); i += step)
  {
    out.cells.push_back(object.cells[i]);
    out.points.push_back(out.R_upright_optical * object.points[i]);
    const auto normal = cloud.normal(object.cells[i].c, object.cells[i].r);
    if (normal)
      out.normals.emplace_back(out.R_upright_optical * normal->cast<double>());
    else
      out.normals.emplace_back();
  }
  return out;
}

}  // namespace quadmap
