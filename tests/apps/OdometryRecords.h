#pragma once

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <functional>
#include <string>
#include <vector>

#include "../sensors/SampleRawlog.h"

namespace quadmap
{
using Record = mrpt::serialization::CSerializable::Ptr;
using Records = std::vector<Record>;

/** All records of a compressed rawlog of stock classes. */
inline Records readRecords(const std::string& path)
{
  mrpt::io::CFileGZInputStream stream(path);
  auto archive = mrpt::serialization::archiveFrom(stream);
  Records records;
  while (true) try
    {
      records.push_back(archive.ReadObject());
    }
    catch (const mrpt::serialization::CExceptionEOF&)
    {
      return records;
    }
}

/** A moment of a recording, with the pose by odometry and the images. */
struct Moment
{
  double time = 0;  // [s]
  mrpt::poses::CPose3D T_odom_robot;
  std::vector<mrpt::obs::CObservation::Ptr> images;
};

/** Makes the record of the pose of a moment. */
using PoseRecord = std::function<mrpt::obs::CObservation::Ptr(const Moment&)>;
using MoveRecord =
    std::function<void(const Moment& before, const Moment&, mrpt::obs::CActionCollection& actions)>;

inline mrpt::poses::CPose2D planar(const mrpt::poses::CPose3D& pose)
{
  return mrpt::poses::CPose2D(pose.x(), pose.y(), pose.yaw());
}

inline mrpt::obs::CObservation::Ptr robotPose(const Moment& m)
{
  auto o = samplePose(m.time, m.T_odom_robot, "tracker");
  o->sensorPose = mrpt::poses::CPose3D(0.3, -0.2, 1.1, 0.5, 0.1, -0.4);  // of the tracker's marker
  for (int i = 0; i < 6; ++i) o->pose.cov(i, i) = 1e-4;
  return o;
}

inline mrpt::obs::CObservationOdometry::Ptr wheels(const Moment& m)
{
  auto o = mrpt::obs::CObservationOdometry::Create();
  o->timestamp = stamp(m.time);
  o->sensorLabel = "wheels";
  o->odometry = planar(m.T_odom_robot);
  return o;
}

/** Odometry of wheels whose counters jump, as when they overflow. Only the pose counts. */
inline mrpt::obs::CObservation::Ptr wheelsWithTicks(const Moment& m)
{
  auto o = wheels(m);
  o->hasEncodersInfo = o->hasVelocities = true;
  o->encoderLeftTicks = static_cast<int>(m.time * 1e6) % 32768;
  o->encoderRightTicks = -o->encoderLeftTicks;
  o->velocityLocal = {0.3, 0, 0.1};
  return o;
}

inline void planarMove(
    const Moment& before,
    const Moment& now,
    mrpt::obs::CActionCollection& actions,
    mrpt::obs::CActionRobotMovement2D::TDrawSampleMotionModel model)
{
  mrpt::obs::CActionRobotMovement2D move;
  move.timestamp = stamp(now.time);
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = model;
  move.computeFromOdometry(planar(now.T_odom_robot) - planar(before.T_odom_robot), options);
  actions.insert(move);
}

inline void gaussianMove(const Moment& a, const Moment& b, mrpt::obs::CActionCollection& actions)
{
  planarMove(a, b, actions, mrpt::obs::CActionRobotMovement2D::mmGaussian);
}

inline void thrunMove(const Moment& a, const Moment& b, mrpt::obs::CActionCollection& actions)
{
  planarMove(a, b, actions, mrpt::obs::CActionRobotMovement2D::mmThrun);
}

/** Adds a motion by matched laser scans, beside a poor one by wheels. */
inline void matchedMove(const Moment& a, const Moment& b, mrpt::obs::CActionCollection& actions)
{
  Moment slipped = b;
  slipped.T_odom_robot += mrpt::poses::CPose3D(0.4, 0, 0, 0.3, 0, 0);
  gaussianMove(a, slipped, actions);
  mrpt::obs::CActionRobotMovement2D move;
  move.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  mrpt::math::CMatrixDouble33 cov;
  cov.setDiagonal(3, 1e-4);
  move.poseChange =
      mrpt::poses::CPosePDFGaussian::Create(planar(b.T_odom_robot) - planar(a.T_odom_robot), cov);
  actions.insert(move);
}

inline void spatialMove(const Moment& a, const Moment& b, mrpt::obs::CActionCollection& actions)
{
  mrpt::obs::CActionRobotMovement3D move;
  move.timestamp = stamp(b.time);
  move.poseChange.mean = b.T_odom_robot - a.T_odom_robot;
  for (int i = 0; i < 6; ++i) move.poseChange.cov(i, i) = 1e-4;
  actions.insert(move);
}

/** A rawlog of observations. */
inline Records observationLog(
    const std::vector<Moment>& moments, const std::vector<PoseRecord>& poses)
{
  Records records;
  for (const Moment& m : moments)
  {
    for (const auto& poseOf : poses) records.push_back(poseOf(m));
    records.insert(records.end(), m.images.begin(), m.images.end());
  }
  return records;
}

/** A rawlog of actions and sensory frames in turn. Poses are observations of the frames. */
inline Records actionLog(
    const std::vector<Moment>& moments,
    const MoveRecord& move,
    const std::vector<PoseRecord>& poses)
{
  Records records;
  for (std::size_t i = 0; i < moments.size(); ++i)
  {
    auto actions = mrpt::obs::CActionCollection::Create();
    if (i > 0 && move) move(moments[i - 1], moments[i], *actions);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    for (const auto& poseOf : poses) frame->insert(poseOf(moments[i]));
    for (const auto& image : moments[i].images) frame->insert(image);
    records.push_back(actions);
    records.push_back(frame);
  }
  return records;
}

}  // namespace quadmap
