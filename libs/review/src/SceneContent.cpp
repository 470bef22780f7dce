#include "quadmap/review/SceneContent.h"

#include <algorithm>

#include "quadmap/geometry/CuboidExtent.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
void addCorners(const std::vector<ObjectRecord>& objects, std::vector<Eigen::Vector3d>& out)
{
  for (const ObjectRecord& record : objects)
  {
    const Eigen::Matrix<double, 3, 8> corners = record.object.cuboidCorners();
    for (int i = 0; i < 8; ++i) out.push_back(corners.col(i));
  }
}

}  // namespace

double SceneContent::floorHeight() const
{
  constexpr double kLow = 0.1;  // a few objects may reach below the floor
  std::vector<double> heights;
  for (const auto& list : {objects, truth})
    for (const ObjectRecord& record : list) heights.push_back(cuboidBottom(record.object));
  if (heights.empty())
    for (const CloudPoint& p : cloud) heights.push_back(static_cast<double>(p.position.z()));
  if (heights.empty())
    for (const auto& pose : trajectory) heights.push_back(pose.z());
  return heights.empty() ? 0.0 : quantile(std::move(heights), kLow);
}

bool SceneContent::odometryDiffers() const
{
  constexpr double kVisible = 0.01;  // least distance that can be seen [m]
  if (odometry.size() != trajectory.size()) return true;
  for (std::size_t i = 0; i < odometry.size(); ++i)
    if ((positionOf(odometry[i]) - positionOf(trajectory[i])).norm() > kVisible) return true;
  return false;
}

std::vector<Eigen::Vector3d> SceneContent::extent() const
{
  std::vector<Eigen::Vector3d> points;
  addCorners(objects, points);
  addCorners(truth, points);
  for (const auto& pose : trajectory) points.push_back(positionOf(pose));
  for (const auto& pose : odometry) points.push_back(positionOf(pose));
  for (const CameraPose& camera : cameras) points.push_back(positionOf(camera.T_map_sensor));
  if (points.empty())
    for (const CloudPoint& p : cloud) points.push_back(p.position.cast<double>());
  return points;
}

}  // namespace quadmap
