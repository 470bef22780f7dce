#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "../../maps/ObjectMapFixture.h"
#include "backend/JointBackEnd.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** Once around a room, with odometry that is exact but for what it thinks is up.
 * \return The farthest that a pose is from where it is to the first one [m]. */
double bending(PoseSource source, double wrongUp, const CPose3D& T_robot_camera = {})
{
  constexpr int kFrames = 36;
  const std::vector<TrueObject> world = {
      cuboid("refrigerator", {-1.2, -1.0, 0.6}, {0.6, 0.65, 1.2}, 0.2),
      cuboid("suitcase", {0.9, -1.1, 0.3}, {0.7, 0.4, 0.6}, 0.7),
      cuboid("dining table", {0, 0, 0.375}, {1.4, 0.9, 0.75}, 0.1),
      cuboid("chair", {1.0, 1.0, 0.45}, {0.45, 0.5, 0.9}, 0.4)};
  const CPose3D T_odom_world(0, 0, 0, 0, 0, wrongUp);
  mrpt::math::CMatrixDouble66 covariance;
  for (int i = 0; i < 6; ++i) covariance(i, i) = std::pow(i < 3 ? 0.005 : 0.003, 2);
  SyntheticCamera camera(4);
  SlamResult result;
  result.odometry.source = source;
  JointBackEnd backEnd({}, result.map.insertionOptions, result.map.labels());
  std::vector<CPose3D> truth;
  std::vector<CObservationObjects::Ptr> boxes;
  for (int i = 0; i < kFrames; ++i)
  {
    const CPose3D T_world_camera = poseAround(i, kFrames);
    truth.push_back(T_world_camera + (-T_robot_camera));
    boxes.push_back(CObservationObjects::Create(camera.observe(T_world_camera, world)));
    boxes.back()->sensorPose = T_robot_camera;
    Keyframe keyframe;
    keyframe.T_odom_robot = T_odom_world + truth.back();
    if (i > 0) keyframe.odometryStep = {truth.back() - truth[truth.size() - 2], covariance};
    keyframe.T_map_robot = backEnd.addKeyframe(
        keyframe.T_odom_robot, keyframe.odometryStep, boxes.back().get(), result);
    result.keyframes.push_back(keyframe);
  }
  backEnd.finish([&](std::size_t k) { return boxes[k]; }, result);
  double worst = 0;
  for (std::size_t k = 1; k < truth.size(); ++k)
    worst = std::max(
        worst, (result.keyframes[k].T_map_robot - result.keyframes[0].T_map_robot)
                   .distanceTo(truth[k] - truth[0]));
  return worst;
}
}  // namespace

TEST(FirstPose, AWrongUpOfVisualOdometryBendsNothing)
{
  const double wrong = mrpt::DEG2RAD(2.0);
  const double fixed = bending(PoseSource::Rawlog, wrong),
               free = bending(PoseSource::Visual, wrong);
  EXPECT_LT(free, 0.5 * fixed) << fixed;
  EXPECT_LT(free, 1.5 * bending(PoseSource::Rawlog, 0.0));
}

TEST(FirstPose, MayLookStraightDown)
{
  const double cameraPitch = poseAround(0, 36).pitch();
  const CPose3D T_robot_camera(0, 0, 0, 0, cameraPitch - M_PI / 2, 0);
  const double wrong = mrpt::DEG2RAD(2.0);
  EXPECT_LT(
      bending(PoseSource::Visual, wrong, T_robot_camera),
      1.5 * bending(PoseSource::Rawlog, 0.0, T_robot_camera));
}
