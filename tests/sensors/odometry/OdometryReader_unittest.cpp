#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/random/RandomGenerators.h>

#include <Eigen/Dense>
#include <cmath>

#include "../SampleRawlog.h"
#include "quadmap/geometry/StepCovariance.h"

using namespace quadmap;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

TEST(OdometryReader, ThrunsModelOfMotionIsTheOneMrptDrawsFrom)
{
  mrpt::obs::CActionRobotMovement2D move;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  options.thrunModel.nParticlesCount = 20000;
  mrpt::random::getRandomGenerator().randomize(7);
  const CPose2D step(0.5, 0.2, 0.7);
  move.computeFromOdometry(step, options);
  const auto drawn =
      std::dynamic_pointer_cast<mrpt::poses::CPosePDFParticles>(move.poseChange.get_ptr());
  ASSERT_TRUE(drawn);
  Eigen::Matrix3Xd samples(3, drawn->m_particles.size());
  for (Eigen::Index i = 0; i < samples.cols(); ++i)
  {
    const auto& p = drawn->m_particles[static_cast<std::size_t>(i)].d;
    samples.col(i) << p.x, p.y, p.phi;
  }
  samples.colwise() -= samples.rowwise().mean().eval();
  const Eigen::Matrix3d expected =
      samples * samples.transpose() / static_cast<double>(samples.cols());

  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(move);
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(sampleScan(kStart));
  const TemporaryFolder folder;
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), {actions, frame}));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_LT(frames[0].T_odom_robot.value().distanceTo(CPose3D(step)), 1e-9)
      << "no mean of particles";
  const int at[] = {0, 1, 3};  // x, y, yaw
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(
          frames[0].odometryCovariance.value()(at[i], at[j]), expected(i, j),
          0.05 * std::sqrt(expected(i, i) * expected(j, j)))
          << i << " " << j << ": so many samples tell variances within 1 %; it is not linear";
}

TEST(OdometryReader, TakesTheOdometryThatIsAskedFor)
{
  const TemporaryFolder folder;
  auto wheels = mrpt::obs::CObservationOdometry::Create();
  wheels->timestamp = stamp(kStart);
  wheels->sensorLabel = "wheels";
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {wheels, samplePose(kStart, CPose3D(9, 9, 9, 0, 0, 0), "gps"), sampleScan(kStart)});
  RawlogSourceOptions options;
  options.odometryKind = "CObservationRobotPose gps";
  RawlogSource source(file, options);
  source.setVerbosityLevel(mrpt::system::LVL_ERROR);
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_TRUE(frames[0].T_odom_robot);
  EXPECT_DOUBLE_EQ(frames[0].T_odom_robot->x(), 9.0);
  EXPECT_EQ(frames[0].odometryKind, options.odometryKind);
  EXPECT_EQ(
      source.odometryKinds(),
      (std::vector<std::string>{"CObservationOdometry wheels", "CObservationRobotPose gps"}));
}

TEST(OdometryReader, IncrementsOfEitherClassAreOneKind)
{
  mrpt::obs::CActionRobotMovement2D planar;
  planar.computeFromOdometry(CPose2D(1, 0, 0), {});
  mrpt::obs::CActionRobotMovement3D spatial;
  spatial.poseChange.mean = CPose3D(0, 0, 0.5, 0, 0, 0);
  const auto step = [](const mrpt::obs::CAction& action)
  {
    auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(action);
    return actions;
  };
  const auto frameAt = [](double time)
  {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(sampleScan(time));
    return frame;
  };
  auto wheels = mrpt::obs::CObservationOdometry::Create();
  wheels->timestamp = stamp(kStart);
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {wheels, step(planar), frameAt(kStart), step(spatial), frameAt(kStart + 1)});
  for (const char* kind : {"CActionRobotMovement2D", "CActionRobotMovement3D"})
  {
    RawlogSourceOptions options;
    options.odometryKind = kind;
    RawlogSource source(file, options);
    source.setVerbosityLevel(mrpt::system::LVL_ERROR);
    const auto frames = readAll(source);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_LT(frames[0].T_odom_robot.value().distanceTo(CPose3D(1, 0, 0, 0, 0, 0)), 1e-9) << kind;
    EXPECT_LT(frames[1].T_odom_robot.value().distanceTo(CPose3D(1, 0, 0.5, 0, 0, 0)), 1e-9) << kind;
  }
}

TEST(OdometryReader, BetweenTwoPosesASharedErrorStaysShared)
{
  // After a long way the heading is off by 0.1 rad, and one more step adds 1 mm to the position.
  auto before = samplePose(kStart, CPose3D(5, 0, 0, 0.3, 0, 0));
  for (int i = 0; i < 6; ++i) before->pose.cov(i, i) = i < 3 ? 0.04 : 0.01;
  mrpt::poses::CPose3DPDFGaussian step(CPose3D(0.1, 0.02, 0, 0.1, 0, 0));
  for (int i = 0; i < 6; ++i) step.cov(i, i) = i < 3 ? 1e-6 : 1e-8;
  auto after = samplePose(kStart + 0.1, {});
  after->pose = before->pose + step;
  const TemporaryFolder folder;
  const auto frames = readAll(writeObjects(
      folder.path("x.rawlog"),
      {before, sampleScan(kStart), sampleScan(kStart + 0.04), after, sampleScan(kStart + 0.1)}));
  ASSERT_EQ(frames.size(), 3u);
  for (const std::size_t k : {0u, 1u})
  {
    mrpt::poses::CPose3DPDFGaussian from(frames[k].T_odom_robot.value()),
        to(frames[k + 1].T_odom_robot.value());
    from.cov = frames[k].odometryCovariance.value();
    to.cov = frames[k + 1].odometryCovariance.value();
    const auto added = addedCovariance(from, to);
    ASSERT_TRUE(added) << k;
    EXPECT_LT(std::sqrt(added->diagonal().maxCoeff()), 0.0011) << "[m], [rad]";
  }
}
