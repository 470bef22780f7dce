#include "files/PoseGraphWriter.h"

#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/poses/Lie/SO.h>

#include <Eigen/Dense>
#include <fstream>
#include <sstream>

#include "../../geometry/Algebra.h"
#include "../SyntheticRoom.h"
#include "quadmap/odometry/GraphOdometry.h"
#include "run/ObjectSlam.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kUprightSigma = 0.035;  // of roll and pitch of an object in the graph [rad]

/** A run of six keyframes of one cuboid, written as a graph and read by MRPT. */
class PoseGraphWriter : public ::testing::Test
{
 protected:
  PoseGraphWriter() :
      spool_(folder_.folder().string()), slam_(configuration(), LabelTable::installed(), spool_)
  {
    for (int i = 0; i < kFrames; ++i)
    {
      const auto pose = room_.robotAt(0.25 * i) + CPose3D(0, 0, 0, 0, 0.1, 0.2);  // tilted
      RgbdFrame frame;
      frame.scan = room_.scanFrom(pose, kStart + i);
      frame.objects = room_.boxesOf(*frame.scan, pose);
      frame.T_odom_robot = pose;
      slam_.addFrame(frame);
    }
    slam_.finish();
    write(folder_.path("x.graph"));
    graph_.loadFromTextFile(folder_.path("x.graph"));
  }

  static SlamConfiguration configuration()
  {
    SlamConfiguration c;
    c.keyframes.every = 1;
    return c;
  }

  void write(const std::string& path) const { write(path, slam_.result()); }
  void write(const std::string& path, const SlamResult& result) const
  {
    const auto nodes = poseNodesOf(result.keyframes);
    writePoseGraph(path, nodes, result, spool_, configuration().poses);
  }

  /** Information of (yaw, pitch, roll) in the file, as MRPT 2.5 loses their correlations on
   * reading.
   */
  Eigen::Matrix3d angleInformation(unsigned from, unsigned to) const
  {
    std::ifstream file(folder_.path("x.graph"));
    const std::string start = "EDGE3 " + std::to_string(from) + " " + std::to_string(to) + " ";
    Eigen::Matrix3d rollPitchYaw = Eigen::Matrix3d::Zero();
    for (std::string line; std::getline(file, line);)
    {
      if (line.compare(0, start.size(), start) != 0) continue;
      std::istringstream numbers(line.substr(start.size()));
      double number = 0;
      for (int i = 0; i < 6 + 15; ++i) numbers >> number;  // the pose, and rows x, y, z
      for (int row = 0; row < 3; ++row)
        for (int col = row; col < 3; ++col)
        {
          numbers >> number;
          rollPitchYaw(row, col) = rollPitchYaw(col, row) = number;
        }
    }
    return rollPitchYaw.reverse();
  }

  static constexpr int kFrames = 6;
  SyntheticRoom room_;
  TemporaryFolder folder_;
  KeyframeSpool spool_;
  ObjectSlam slam_;
  mrpt::graphs::CNetworkOfPoses3DInf graph_;
};
}  // namespace

TEST_F(PoseGraphWriter, HasKeyframesAndObjectsAsNodes)
{
  const auto objects = slam_.result().map.confirmedObjects();
  ASSERT_EQ(objects.size(), 1u);
  ASSERT_EQ(graph_.nodeCount(), kFrames + 1u);
  EXPECT_EQ(graph_.root, 0u);
  for (unsigned k = 0; k < kFrames; ++k)
    EXPECT_LT((graph_.nodes.at(k) - slam_.result().keyframes[k].T_map_robot).norm(), 1e-8);
  EXPECT_LT((graph_.nodes.at(kFrames + objects[0]->id) - objects[0]->object.pose()).norm(), 1e-8);
}

TEST_F(PoseGraphWriter, EdgesJoinTheNodesAsTheEstimateHasThem)
{
  const auto id = kFrames + slam_.result().map.confirmedObjects().at(0)->id;
  for (unsigned k = 1; k < kFrames; ++k) EXPECT_TRUE(graph_.edgeExists(k - 1, k));
  for (unsigned k = 0; k < kFrames; ++k) EXPECT_TRUE(graph_.edgeExists(k, id)) << "keyframe " << k;
  EXPECT_EQ(graph_.edgeCount(), 2u * kFrames - 1);
  for (const auto& [ends, edge] : graph_.edges)
  {
    const CPose3D expected = graph_.nodes.at(ends.second) - graph_.nodes.at(ends.first);
    EXPECT_LT((edge.mean - expected).norm(), 1e-8) << ends.first << " to " << ends.second;
  }
}

TEST_F(PoseGraphWriter, OdometryEdgesHaveTheCovarianceOfTheirKeyframe)
{
  SlamResult result = slam_.result();
  auto& stated = result.keyframes[3].odometryStep->cov;
  stated(0, 0) *= 4;
  stated(5, 5) *= 9;
  write(folder_.path("x.graph"), result);
  graph_.loadFromTextFile(folder_.path("x.graph"));
  const Eigen::Matrix<double, 6, 6> product =
      graph_.getEdge(2, 3).cov_inv.asEigen() * stated.asEigen();
  EXPECT_LT((product - Eigen::Matrix<double, 6, 6>::Identity()).norm(), 1e-6);
}

TEST_F(PoseGraphWriter, SurvivesThatMrptForgetsHowAnglesCorrelate)
{
  SlamResult result = slam_.result();
  auto& stated = result.keyframes[3].odometryStep->cov;
  Eigen::Matrix<double, 6, 1> together, alike;  // almost one error, as of a camera that turns
  together << 1, -2, 1, 2, 1, -1;
  alike << 1, 1, -1, 1, -2, 2;
  stated.asEigen() = 1e-4 * (together * together.transpose() + alike * alike.transpose()) +
                     1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
  write(folder_.path("x.graph"), result);
  graph_.loadFromTextFile(folder_.path("x.graph"));
  const Eigen::Matrix<double, 6, 6> covariance = inverseOf(graph_.getEdge(2, 3).cov_inv.asEigen());
  EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  const double rounding = 1e-4 * stated(0, 0);  // ten digits, of a matrix that is almost singular
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(covariance(i, i), stated(i, i), rounding) << i;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(covariance(i, j), stated(i, j), rounding);
  EXPECT_NO_THROW(GraphOdometry(folder_.path("x.graph")));
}

TEST_F(PoseGraphWriter, MeasurementEdgesHaveTheInformationOfTheEstimation)
{
  const auto id = kFrames + slam_.result().map.confirmedObjects().at(0)->id;
  ASSERT_EQ(slam_.result().edges.size(), std::size_t(kFrames));
  for (const auto& edge : slam_.result().edges)
  {
    const auto& written = graph_.getEdge(edge.pose, id);
    for (int i = 0; i < 6; ++i)
    {
      const double expected = i < 3 ? edge.positionInformation : edge.angleInformation;
      EXPECT_NEAR(written.cov_inv(i, i), expected, 1e-6 * expected);
    }
  }
}

TEST_F(PoseGraphWriter, AnglesOfGivenPosesCarryTheInformationOfUprightAndYaw)
{
  SlamResult given = slam_.result();
  given.edges.clear();
  write(folder_.path("x.graph"), given);
  graph_.loadFromTextFile(folder_.path("x.graph"));
  const auto id = kFrames + slam_.result().map.confirmedObjects().at(0)->id;
  for (unsigned k = 0; k < kFrames; ++k)
  {
    const auto boxes = spool_.objects(k);
    const auto& measurement = boxes->objects.at(0).measurement;
    ASSERT_TRUE(measurement.complete && measurement.complete->yawDefined);
    const auto& edge = graph_.getEdge(k, id);
    // Oracle: numeric derivative of the turn in the object's frame by yaw, pitch and roll
    constexpr double kStep = 1e-6;
    Eigen::Matrix3d J;
    for (unsigned i = 0; i < 3; ++i)
    {
      auto v = edge.mean.asVectorVal();
      v[static_cast<int>(3 + i)] += kStep;
      const CPose3D moved(v[0], v[1], v[2], v[3], v[4], v[5]);
      const auto turn = mrpt::poses::Lie::SO<3>::log((moved - edge.mean).getRotationMatrix());
      for (int row = 0; row < 3; ++row) J(row, static_cast<int>(i)) = turn[row] / kStep;
    }
    const Eigen::Vector3d sigmas(kUprightSigma, kUprightSigma, measurement.complete->yawSigma);
    const Eigen::Vector3d weights = sigmas.cwiseAbs2().cwiseInverse();
    const Eigen::Matrix3d expected = J.transpose() * weights.asDiagonal() * J;
    const Eigen::Matrix3d got = angleInformation(k, id);
    EXPECT_LT((got - expected).norm(), 1e-4 * expected.norm());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(edge.cov_inv(3 + i, 3 + i), got(i, i), 1e-3);
  }
}

TEST_F(PoseGraphWriter, NoObjectIsLoose)
{
  SlamResult unseen = slam_.result();
  unseen.edges.clear();
  unseen.decisions.clear();
  write(folder_.path("x.graph"), unseen);
  graph_.loadFromTextFile(folder_.path("x.graph"));
  const auto id = kFrames + slam_.result().map.confirmedObjects().at(0)->id;
  ASSERT_TRUE(graph_.edgeExists(0, id));
  EXPECT_LT((graph_.getEdge(0, id).mean - (graph_.nodes.at(id) - graph_.nodes.at(0))).norm(), 1e-8);
  EXPECT_LT(graph_.getEdge(0, id).cov_inv(0, 0), 1e-3);
}

TEST_F(PoseGraphWriter, FullDiskIsAnErrorAndLeavesNothing)
{
  const auto before = folder_.fileCount();
  const FileSizeLimit limit(100);
  const auto path = folder_.path("y.graph");
  const std::string error = errorOf([&] { write(path); });
  EXPECT_EQ(error, path + ": cannot be written: File too large");
  EXPECT_EQ(folder_.fileCount(), before);
}
