#include "quadmap/slam/PoseNodes.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
Keyframe image(const std::string& sensor, double time, const CPose3D& pose)
{
  return {0, sensor, time, pose, pose};
}

using Indices = std::vector<std::size_t>;
}  // namespace

TEST(PoseNodes, CamerasWithOneTimeStampShareANode)
{
  const CPose3D a(1, 0, 0, 0, 0, 0), b(2, 0, 0, 0.5, 0, 0);
  const auto nodes = poseNodesOf(
      {image("front", 1, a), image("rear", 1, a), image("front", 2, b), image("rear", 2, b)});
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[0].keyframes, (Indices{0, 1}));
  EXPECT_EQ(nodes[1].keyframes, (Indices{2, 3}));
  EXPECT_EQ(nodes[1].time, 2);
  EXPECT_EQ(nodes[1].T_map_robot, b);
  EXPECT_EQ(nodeOfEachKeyframe(nodes), (Indices{0, 0, 1, 1}));
}

TEST(PoseNodes, StandInTheOrderOfTime)
{
  // The second camera's images reach the file late
  const auto nodes = poseNodesOf(
      {image("front", 1, CPose3D(1, 0, 0, 0, 0, 0)), image("front", 3, CPose3D(3, 0, 0, 0, 0, 0)),
       image("rear", 2, CPose3D(2, 0, 0, 0, 0, 0))});
  ASSERT_EQ(nodes.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n)
  {
    EXPECT_EQ(nodes[n].time, 1.0 + static_cast<double>(n));
    EXPECT_EQ(nodes[n].T_map_robot.x(), nodes[n].time);
  }
  EXPECT_EQ(nodeOfEachKeyframe(nodes), (Indices{0, 2, 1}));
}

TEST(PoseNodes, AStandingRobotsCamerasShareANodeInSpiteOfTheirTimes)
{
  const CPose3D pose(1, 2, 0, 0.3, 0, 0);
  std::vector<Keyframe> images;
  for (int i = 0; i < 4; ++i)
    images.push_back(image("RGBD_" + std::to_string(i + 1), 1 + 0.02 * i, pose));
  EXPECT_EQ(poseNodesOf(images).size(), 1u);
  images.push_back(image("RGBD_1", 1.09, pose));
  EXPECT_EQ(poseNodesOf(images).size(), 2u) << "each sensor once";
  images.back() = image("RGBD_5", 1.2, pose);
  EXPECT_EQ(poseNodesOf(images).size(), 2u) << "too long after the first";
}

TEST(PoseNodes, AMovingRobotsCamerasSawFromDifferentPoses)
{
  const CPose3D pose(1, 2, 0, 0.3, 0, 0);
  for (const CPose3D& step :
       {CPose3D(0.002, 0, 0, 0, 0, 0), CPose3D(0, 0, 0, mrpt::DEG2RAD(0.1), 0, 0)})
  {
    const auto nodes = poseNodesOf({image("a", 1, pose), image("b", 1.01, pose + step)});
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_EQ(nodes[1].T_map_robot, pose + step);
  }
}
