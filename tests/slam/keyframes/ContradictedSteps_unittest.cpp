#include "keyframes/ContradictedSteps.h"

#include <gtest/gtest.h>

#include "../../sensors/SampleRawlog.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** Things of a room, whose places are known [m]. */
const std::vector<std::pair<std::string, Eigen::Vector3d>> kRoom = {
    {"chair",     {2, 0, 0.5}},
    {"chair", {2.1, 0.9, 0.5}},
    {  "cup",   {3, 0.4, 0.8}},
    {   "tv",    {4, -1, 1.2}}
};

/** A keyframe that shows the first things of the room.
 *  \param T_room_robot Where the robot is. \param T_odom_robot Where the odometry has it. */
KeyframeTask keyframe(
    const CPose3D& T_room_robot, const CPose3D& T_odom_robot, std::size_t things = kRoom.size())
{
  KeyframeTask task;
  task.frame.record = 7;
  task.frame.scan = sampleScan(kStart);
  task.T_odom_robot = T_odom_robot;
  task.boxes = CObservationObjects::Create();
  for (std::size_t i = 0; i < things; ++i)
  {
    const Eigen::Vector3d& p = kRoom[i].second;
    const CPose3D T_room_object(p.x(), p.y(), p.z(), 0, 0, 0);
    DetectedObject object;
    object.label = kRoom[i].first;
    object.measurement.complete.emplace(
        CompleteMeasurement{Ellipsoid(T_room_object - T_room_robot, {0.2, 0.2, 0.3}), {}});
    task.boxes->objects.push_back(object);
  }
  return task;
}
}  // namespace

TEST(ContradictedSteps, OdometryThatJumpsIsContradictedByThingsThatDoNot)
{
  const CPose3D start, moved(0.3, 0.1, 0, 0.2, 0, 0), jump(0.8, 0, 0, 0, 0, 0);
  ContradictedSteps steps;
  steps.add(keyframe(start, start));
  steps.add(keyframe(moved, moved));
  EXPECT_EQ(steps.warning(), "");
  steps.add(keyframe(moved, jump + moved));
  EXPECT_EQ(
      steps.warning(),
      "the objects contradict the odometry, first before record 7 (camera), where 4 objects seem "
      "to "
      "have moved by 0.80 m (1 in all): poses and objects are doubtful");
}

TEST(ContradictedSteps, WhatIsNotCertainIsNoContradiction)
{
  const CPose3D start, little(0.3, 0, 0, 0, 0, 0), jump(0.8, 0, 0, 0, 0, 0);
  const auto warning = [&](const KeyframeTask& second)
  {
    ContradictedSteps steps;
    steps.add(keyframe(start, start));
    steps.add(second);
    return steps.warning();
  };
  EXPECT_EQ(warning(keyframe(start, little)), "") << "an error of the measurements?";
  EXPECT_EQ(warning(keyframe(start, jump, 2)), "") << "two people who walk?";
  auto rear = keyframe(start, jump);
  rear.frame.scan->sensorLabel = "rear";
  EXPECT_EQ(warning(rear), "") << "another camera sees other things";
  auto other = keyframe(start, jump);
  for (auto& object : other.boxes->objects) object.label = "book";
  EXPECT_EQ(warning(other), "") << "another place, to which the robot was carried";
  auto blind = keyframe(start, jump);
  blind.boxes.reset();
  EXPECT_EQ(warning(blind), "");
}
