#include "quadmap/slam/PoseNodes.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/poses/Lie/SO.h>

#include <algorithm>
#include <numeric>

#include "quadmap/odometry/SingleMoment.h"

namespace quadmap
{
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
constexpr double kSamePlace = 0.0005;               //!< Far less than depth cameras can tell [m]
const double kSameDirection = mrpt::DEG2RAD(0.02);  //!< A millimetre at 3 m [rad]

bool isSamePose(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b)
{
  const mrpt::poses::CPose3D T_a_b = b - a;
  return T_a_b.norm() <= kSamePlace &&
         mrpt::poses::Lie::SO<3>::log(T_a_b.getRotationMatrix()).norm() <= kSameDirection;
}

bool belongsTo(const PoseNode& node, const Keyframe& image, const std::vector<Keyframe>& all)
{
  return image.time - node.time <= kMoment && isSamePose(node.T_odom_robot, image.T_odom_robot) &&
         std::none_of(
             node.keyframes.begin(), node.keyframes.end(),
             [&](std::size_t k) { return all[k].sensor == image.sensor; });
}

}  // namespace

std::vector<PoseNode> poseNodesOf(const std::vector<Keyframe>& keyframes)
{
  std::vector<std::size_t> order(keyframes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return keyframes[a].time < keyframes[b].time; });
  std::vector<PoseNode> nodes;
  for (const std::size_t k : order)
  {
    const Keyframe& image = keyframes[k];
    if (nodes.empty() || !belongsTo(nodes.back(), image, keyframes))
      nodes.push_back({image.time, image.T_map_robot, image.T_odom_robot, {}});
    nodes.back().keyframes.push_back(k);
  }
  return nodes;
}

std::vector<CPose3DPDFGaussian> poseDistributions(
    const std::vector<PoseNode>& nodes,
    const std::vector<Keyframe>& keyframes,
    PoseCovarianceChain chain)
{
  const bool estimated = std::all_of(
      keyframes.begin(), keyframes.end(), [](const auto& k) { return k.covariance.has_value(); });
  std::vector<CPose3DPDFGaussian> poses;
  poses.reserve(nodes.size());
  for (const auto& node : nodes)
    poses.push_back(
        estimated
            ? CPose3DPDFGaussian(node.T_map_robot, *keyframes[node.keyframes.front()].covariance)
            : chain.next(node.T_map_robot));
  return poses;
}

std::vector<std::size_t> nodeOfEachKeyframe(const std::vector<PoseNode>& nodes)
{
  std::vector<std::size_t> nodeOf;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const std::size_t k : nodes[n].keyframes)
    {
      nodeOf.resize(std::max(nodeOf.size(), k + 1));
      nodeOf[k] = n;
    }
  return nodeOf;
}

}  // namespace quadmap
