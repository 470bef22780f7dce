#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>

#include <random>

#include "../../sensors/SampleRawlog.h"
#include "../../sensors/StopAfter.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using Graph = mrpt::graphs::CNetworkOfPoses3DInf;

namespace
{
/** The pose graph that a run on the bundled rawlog writes, optimised by MRPT. */
class PoseGraphOptimised : public ::testing::TestWithParam<PoseSource>
{
 protected:
  PoseGraphOptimised()
  {
    constexpr int kFrames = 40;
    RawlogRunRequest request;
    request.rawlog = QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog";
    request.outputDirectory = folder_.path("out");
    request.configuration.slam.odometry = GetParam();
    stopAfter(request, kFrames);
    runOnRawlog(request);
    trajectory_ = readTumTrajectory(folder_.path("out/trajectory.tum"));
    odometry_ = readTumTrajectory(folder_.path("out/trajectory_odometry.tum"));
    graph_.loadFromTextFile(folder_.path("out/pose-graph.graph"));
  }

  /** Largest distance of a pose from the run's trajectory [m]. */
  double farthestFromTrajectory(const Graph& graph) const
  {
    double farthest = 0;
    for (std::size_t k = 0; k < trajectory_.size(); ++k)
      farthest = std::max(farthest, graph.nodes.at(k).distanceTo(trajectory_[k].pose));
    return farthest;
  }

  static Graph optimised(Graph graph)
  {
    mrpt::graphslam::TResultInfoSpaLevMarq info;
    mrpt::graphslam::optimize_graph_spa_levmarq(graph, info);
    return graph;
  }

  TemporaryFolder folder_;
  Trajectory trajectory_, odometry_;
  Graph graph_;
};
}  // namespace

constexpr double kSameTrajectory = 0.01;  // [m]

TEST_P(PoseGraphOptimised, MrptFindsTheTrajectoryOfTheRun)
{
  ASSERT_GE(graph_.nodeCount(), trajectory_.size() + 4) << "poses, and several objects";
  EXPECT_LT(farthestFromTrajectory(optimised(graph_)), kSameTrajectory);
}

TEST_P(PoseGraphOptimised, AlsoFromTheOdometry)
{
  for (std::size_t k = 1; k < odometry_.size(); ++k)
    graph_.nodes.at(k) = graph_.nodes.at(0) + (odometry_[k].pose - odometry_[0].pose);
  EXPECT_LT(farthestFromTrajectory(optimised(graph_)), kSameTrajectory);
}

TEST_P(PoseGraphOptimised, AlsoFromFarAway)
{
  std::mt19937 random(1);
  const auto gauss = [&](double sigma)
  { return std::normal_distribution<double>(0, sigma)(random); };
  constexpr double kMove = 0.1, kTurn = 0.05;  // [m], [rad]
  for (auto& [id, pose] : graph_.nodes)
  {
    if (id == graph_.root) continue;
    double step[6];  // drawn in this order whatever the compiler
    for (int i = 0; i < 6; ++i) step[i] = gauss(i < 3 ? kMove : kTurn);
    pose = pose + CPose3D(step[0], step[1], step[2], step[3], step[4], step[5]);
  }
  EXPECT_GT(farthestFromTrajectory(graph_), 0.2) << "[m], the start";
  EXPECT_LT(farthestFromTrajectory(optimised(graph_)), kSameTrajectory);
}

INSTANTIATE_TEST_SUITE_P(
    PosesFrom,
    PoseGraphOptimised,
    ::testing::Values(PoseSource::Rawlog, PoseSource::GroundTruth),
    [](const auto& source) { return source.param == PoseSource::Rawlog ? "Odometry" : "Truth"; });
