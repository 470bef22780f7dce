#include "ViewedDrift.h"

#include <utility>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
namespace
{
/** What the increments (w, d) of a pose at `position` do to a place that it sees. */
Eigen::Matrix<double, 3, 6> moveOf(const Eigen::Vector3d& place, const Eigen::Vector3d& position)
{
  Eigen::Matrix<double, 3, 6> J;
  J << -crossMatrix(place - position), Eigen::Matrix3d::Identity();
  return J;
}

}  // namespace

std::optional<ViewedDrift> ViewedDrift::of(
    FactorGraph& graph,
    const std::vector<std::size_t>& keyframes,
    const OdometryDrift& odometry,
    const std::function<bool()>& shouldStop)
{
  auto joint = graph.jointMarginal(keyframes, shouldStop);
  if (!joint) return std::nullopt;
  ViewedDrift drift(odometry);
  drift.joint_ = std::move(*joint);
  Eigen::Index row = 0;
  for (const std::size_t k : keyframes)
  {
    drift.poses_[k] = {positionOf(graph.pose(k)), row};
    row += 6;
  }
  return drift;
}

/** (16.26): what moves the later pose of each moves the thing, and what moves the earlier one moves
 * where it should be. */
Eigen::Matrix3d ViewedDrift::covariance(const Moved& a, const Moved& b) const
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& [i, signOfA] : {std::pair(a.again, 1), std::pair(a.before, -1)})
    for (const auto& [j, signOfB] : {std::pair(b.again, 1), std::pair(b.before, -1)})
    {
      const Pose &p = poses_.at(i), &q = poses_.at(j);
      sum += signOfA * signOfB * moveOf(a.place, p.position) * joint_.block<6, 6>(p.row, q.row) *
             moveOf(b.place, q.position).transpose();
    }
  Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();
  drift.topLeftCorner<2, 2>() = sum.topLeftCorner<2, 2>();
  drift(2, 2) = odometry_.covariance(a, b)(2, 2);
  return drift;
}

}  // namespace quadmap
