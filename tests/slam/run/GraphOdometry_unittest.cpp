#include "quadmap/odometry/GraphOdometry.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "../SyntheticRoom.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace
{
// The text has x y z roll pitch yaw, the information row by row from the diagonal on.
const std::string kNodes =
    "# TIME 0 100.0\nVERTEX3 0 0 0 0 0 0 0\nFIX 0\n"
    "# TIME 1 100.5\n# TIME 1 100.52\nVERTEX3 1 1 0 0 0 0 0.5\n"
    "# TIME 2 101.0\nVERTEX3 2 2 1 0 0 0 1\n"
    "VERTEX3 7 5 5 0 0 0 0\n";
const std::string kForward =
    "EDGE3 0 1 1 0 0 0 0 0.5 100 20 0 0 0 30  200 0 0 0 0  300 0 0 0  5000 0 0  6000 0  7000\n";
/** Information of kForward in MRPT's order, x y z yaw pitch roll. */
Matrix6 forwardInformation()
{
  Eigen::Matrix<double, 6, 1> diagonal;
  diagonal << 100, 200, 300, 7000, 6000, 5000;
  Matrix6 information = diagonal.asDiagonal();
  information(0, 1) = information(1, 0) = 20;
  information(0, 3) = information(3, 0) = 30;
  return information;
}

class GraphOdometryFile : public ::testing::Test
{
 protected:
  GraphOdometry read(const std::string& text) const
  {
    return GraphOdometry(folder_.write("x.graph", text));
  }
  std::string errorIn(const std::string& text) const
  {
    return errorOf([&] { read(text); });
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(GraphOdometryFile, GivesTheImagesOfANodesTimesItsPose)
{
  auto graph = read(kNodes + kForward);
  EXPECT_LT((graph.poseAt(100.0).value() - CPose3D()).norm(), 1e-9);
  EXPECT_LT((graph.poseAt(100.5004).value() - CPose3D(1, 0, 0, 0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((graph.poseAt(100.52).value() - CPose3D(1, 0, 0, 0.5, 0, 0)).norm(), 1e-9);
  EXPECT_FALSE(graph.poseAt(100.51)) << "an image between two that have the pose";
  EXPECT_FALSE(graph.poseAt(99.9));
  EXPECT_FALSE(graph.poseAt(101.1));
  EXPECT_NO_THROW(graph.requireAllUsed());
}

TEST_F(GraphOdometryFile, EdgesSayHowUncertainAStepIs)
{
  const PoseUncertaintyOptions options;
  auto graph = read(kNodes + kForward);
  graph.poseAt(100.0);
  EXPECT_FALSE(graph.takeStep(options)) << "there is nothing before";
  graph.poseAt(100.5);
  const auto first = graph.takeStep(options).value();
  EXPECT_LT((first.mean - CPose3D(1, 0, 0, 0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT(
      (first.cov.asEigen() * forwardInformation() - Matrix6::Identity()).cwiseAbs().maxCoeff(),
      1e-9);

  graph.poseAt(101.0);
  const auto second = graph.takeStep(options).value();
  const auto silent = odometryStep(options, CPose3D(1, 0, 0, 0.5, 0, 0), CPose3D(2, 1, 0, 1, 0, 0));
  EXPECT_LT((second.mean - silent.mean).norm(), 1e-9);
  EXPECT_LT((second.cov.asEigen() - silent.cov.asEigen()).norm(), 1e-12) << "no edge";

  auto over = read(kNodes + kForward);
  over.poseAt(100.0);
  over.takeStep(options);
  over.poseAt(101.0);
  const auto both = over.takeStep(options).value();
  EXPECT_LT((both.mean - CPose3D(2, 1, 0, 1, 0, 0)).norm(), 1e-9);
  EXPECT_GT(both.cov(0, 0), first.cov(0, 0)) << "two steps know less than one";
  over.poseAt(100.5);
  EXPECT_LT((over.takeStep(options)->mean + second.mean).norm(), 1e-9) << "backwards in time";
}

TEST_F(GraphOdometryFile, AnEdgeMayPointBackwards)
{
  const std::string backward =
      "EDGE3 1 0 -0.877582562 0.479425539 0 0 0 -0.5 " + kForward.substr(kForward.find("100 20"));
  auto graph = read(kNodes + backward);
  graph.poseAt(100.0);
  graph.takeStep({});
  graph.poseAt(100.5);
  const auto step = graph.takeStep({}).value();
  EXPECT_LT((step.mean - CPose3D(1, 0, 0, 0.5, 0, 0)).norm(), 1e-9);
  // Independent: the inverse pose, differentiated numerically.
  const CPose3D edge(-0.877582562, 0.479425539, 0, -0.5, 0, 0);
  Matrix6 J;
  constexpr double h = 1e-6;
  for (int i = 0; i < 6; ++i)
  {
    const auto inverseAt = [&](double by)
    {
      Eigen::Matrix<double, 6, 1> v;
      for (int k = 0; k < 6; ++k) v[k] = edge[static_cast<unsigned>(k)] + (k == i ? by : 0);
      const CPose3D inverse = -CPose3D(v[0], v[1], v[2], v[3], v[4], v[5]);
      for (int k = 0; k < 6; ++k) v[k] = inverse[static_cast<unsigned>(k)];
      return v;
    };
    J.col(i) = (inverseAt(h) - inverseAt(-h)) / (2 * h);
  }
  const Matrix6 expected = J * forwardInformation().inverse() * J.transpose();
  EXPECT_LT((step.cov.asEigen() - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(GraphOdometryFile, TellsOfPosesAndImagesThatDoNotFit)
{
  const auto warningAfter = [&](const std::vector<double>& images)
  {
    auto graph = read(kNodes + kForward);
    for (const double time : images) graph.poseAt(time);
    return graph.warning();
  };
  EXPECT_EQ(warningAfter({100, 100.2, 100.5, 100.52, 101, 101.4}), "") << "as in a run's own graph";
  const std::string file = folder_.path("x.graph") + ": ";
  EXPECT_EQ(warningAfter({100, 101}), file + "1 of 3 poses have the time of no image");
  EXPECT_EQ(
      warningAfter({99, 100, 100.5, 101, 101.6, 102}),
      file + "3 of 6 images are before all poses or behind them, by more than these are apart");
  EXPECT_EQ(
      warningAfter({100.5, 101.0, 102}), file +
                                             "1 of 3 poses have the time of no image, and 1 of 3 "
                                             "images are before all poses or behind "
                                             "them, by more than these are apart");
  EXPECT_EQ(warningAfter({42}), "") << "that no image has a pose is an error";
}

TEST_F(GraphOdometryFile, TellsThatItsLastNumberMayBeCut)
{
  const std::string text = kNodes + kForward, file = folder_.path("x.graph") + ": ";
  const std::string mayBeCut = "ends without a line break: its last line may be cut off";
  EXPECT_EQ(read(text).warning(), "");
  EXPECT_EQ(read(text.substr(0, text.size() - 2)).warning(), file + mayBeCut);
  auto graph = read(text.substr(0, text.size() - 2));
  for (const double time : {100., 101.}) graph.poseAt(time);
  EXPECT_EQ(graph.warning(), file + mayBeCut + "; 1 of 3 poses have the time of no image");
}

TEST_F(GraphOdometryFile, WithoutTimesNodesAreTheImagesInTheirOrder)
{
  const std::string text =
      "VERTEX3 3 0 0 0 0 0 0\nVERTEX3 4 1 0 0 0 0 0\nVERTEX3 5 9 9 9 0 0 0\n"
      "EDGE3 3 4 1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
      "EDGE3 3 5 1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  auto graph = read(text);
  EXPECT_LT(graph.poseAt(50).value().norm(), 1e-9);
  const std::string fewer = errorOf([&] { graph.requireAllUsed(); });
  EXPECT_NE(fewer.find("2 robot poses without times"), std::string::npos) << fewer;
  EXPECT_NE(fewer.find("has 1 images"), std::string::npos) << fewer;
  EXPECT_NEAR(graph.poseAt(51)->x(), 1, 1e-9);
  EXPECT_NO_THROW(graph.requireAllUsed());
  const std::string more = errorOf([&] { graph.poseAt(52); });
  EXPECT_NE(more.find("the recording has more images"), std::string::npos)
      << more << ": node 5 is no robot pose, no edge joins it to the one before";
}

TEST_F(GraphOdometryFile, WhatIsNoGraphIsAnErrorOnOneLine)
{
  const std::string noInformation =
      "EDGE3 0 1 1 0 0 0 0 0.5 0 0 0 0 0 0  0 0 0 0 0  0 0 0 0  0 0 0  0 0  0\n";
  std::string many;
  for (int i = 0; i <= 400'000; ++i) many += "EDGE3\n";
  const std::pair<std::string, std::string> cases[] = {
      {                                              many,"400000 lines"                                                          },
      {                                                "",             "no pose graph, it has no VERTEX3 line"},
      {                                 "VERTEX3 0 1 2\n",                                           "VERTEX3"},
      {                kNodes + "VERTEX3 0 0 0 0 0 0 0\n",           "x.graph:10: node 0 is in line 2 already"},
      {                kNodes + "EDGE3 2 9 1 0 0 0 0 0\n", "x.graph:10: an edge of node 9, which is not there"},
      {                kNodes + "EDGE3 0 1.5 1 0 0 0 0\n",     "x.graph:10: '1.5' is not the number of a node"},
      {      kNodes + "VERTEX_SE3:QUAT 9 1 2 3 0 0 0 2\n",
       "x.graph:10: the quaternion has the length 2 instead of 1"                                             },
      {kNodes + "EDGE_SE3:QUAT 0 1 1 2 3 0 0 0 0 1 0 0\n",                "x.graph:10: the quaternion is zero"},
      {                      kNodes + "# TIME 7 100.52\n",         "x.graph:10: node 7 has the time of node 1"},
      {                         kNodes + "# TIME 3 102\n",              "a TIME of node 3, which is not there"},
      {                       kNodes + "# TIME two 102\n",          "x.graph:10: expected # TIME node seconds"},
      {                    std::string("# TIME 0 1\0 2\n",                                                 14),"x.graph:1: has a zero byte"},
      {                            kNodes + noInformation,
       "the information of the edge between 0 and 1 is not positive definite"                                                   },
  };
  for (const auto& [text, expected] : cases)
  {
    const std::string error = errorIn(text);
    EXPECT_NE(error.find(expected), std::string::npos) << error;
    EXPECT_EQ(error.find(folder_.path("x.graph")), 0u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  ::testing::internal::CaptureStderr();
  const std::string nonsense = errorIn("\x1b[2J is none\nnor this\n");
  EXPECT_NE(nonsense.find("x.graph:1: '?[2J' is no entry of a pose graph"), std::string::npos)
      << nonsense;
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "MRPT prints nothing itself";
  EXPECT_EQ(
      errorOf([] { GraphOdometry("/nowhere/x.graph"); }),
      "/nowhere/x.graph: cannot be read: No such file or directory");
}

TEST_F(GraphOdometryFile, TheGraphOfARunIsTheOdometryOfAnother)
{
  RawlogRunRequest request;
  request.rawlog = writeRecording(folder_.path("x.rawlog"));
  request.outputDirectory = folder_.path("first");
  request.configuration.keyframes.every = 2;
  const auto first = runOnRawlog(request).result;
  ASSERT_EQ(first.keyframes.size(), 3u);

  request.outputDirectory = folder_.path("second");
  request.configuration.keyframes = {};
  request.configuration.slam.setOdometry("graph:" + folder_.path("first/pose-graph.graph"));
  const auto second = runOnRawlog(request).result;
  EXPECT_TRUE(second.warnings.empty());
  ASSERT_EQ(second.keyframes.size(), 3u) << "what had a node";
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(second.keyframes[k].record, first.keyframes[k].record);
    EXPECT_LT((second.keyframes[k].T_odom_robot - first.keyframes[k].T_map_robot).norm(), 1e-8);
  }
  const auto a = readObjectsJson(folder_.path("first/objects.json"));
  const auto b = readObjectsJson(folder_.path("second/objects.json"));
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].label, b[0].label);
  EXPECT_LT((a[0].object.center() - b[0].object.center()).norm(), 0.005) << "its noise is a pixel";
}

TEST_F(GraphOdometryFile, PlanarGraphsSayNothingOfHeightAndTilt)
{
  const PoseUncertaintyOptions options;
  for (const bool forward : {true, false})
  {
    // x y phi; information xx xy xp yy yp pp
    auto graph = read(
        std::string("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0.5\n") +
        (forward ? "EDGE_SE2 0 1 1 0 0.5 100 20 30 200 0 7000\n"
                 : "EDGE_SE2 1 0 -0.877583 0.479426 -0.5 100 0 0 100 0 7000\n"));
    graph.poseAt(1);
    graph.takeStep(options);
    EXPECT_LT((graph.poseAt(2).value() - CPose3D(1, 0, 0, 0.5, 0, 0)).norm(), 1e-9);
    const auto step = graph.takeStep(options).value();
    const auto usual = odometryStep(options, CPose3D(), CPose3D(1, 0, 0, 0.5, 0, 0));
    for (const int i : {2, 4, 5}) EXPECT_NEAR(step.cov(i, i), usual.cov(i, i), 1e-12) << i;
    EXPECT_EQ(Matrix6(step.cov.asEigen()).llt().info(), Eigen::Success);
    if (!forward) continue;
    Eigen::Matrix3d information, covariance;
    information << 100, 20, 30, 20, 200, 0, 30, 0, 7000;
    const int at[] = {0, 1, 3};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) covariance(r, c) = step.cov(at[r], at[c]);
    EXPECT_LT((covariance * information - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  }
}
