// How long the whole back end takes for 1,000 keyframes, 100 objects and 10,000 measurements: while
// running, and at the end, with association, optimisation and a new map in each round. One core.

#include <cstdio>
#include <ctime>

#include "../maps/SyntheticScene.h"
#include "backend/JointBackEnd.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
constexpr int kKeyframes = 1000, kObjects = 100, kRounds = 5;
constexpr double kRadius = 12;  // of the robot's way [m]
constexpr double kRange = 10;   // an object is seen up to here [m]

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<TrueObject> furniture()
{
  const char* labels[] = {"chair", "suitcase", "refrigerator", "couch", "bed"};
  std::vector<TrueObject> objects;
  for (int i = 0; i < kObjects; ++i)
  {
    const double at = 2 * M_PI * i / kObjects, far = kRadius + (i % 2 == 0 ? 1.6 : -0.9);
    const Eigen::Vector3d size(0.5 + 0.1 * (i % 3), 0.5, 0.6 + 0.1 * (i % 4));
    objects.push_back(cuboid(
        labels[i % 5], {far * std::cos(at), far * std::sin(at), size.z() / 2}, size,
        0.1 * (i % 7)));
  }
  return objects;
}

/** Three times around; odometry errs by 1 cm and 0.05 deg per step. */
struct Drive
{
  Drive()
  {
    SyntheticCamera camera(1);
    const auto objects = furniture();
    for (int k = 0; k < kKeyframes; ++k)
    {
      const double at = 3 * 2 * M_PI * k / kKeyframes;
      const CPose3D truth(kRadius * std::cos(at), kRadius * std::sin(at), 0, at + M_PI / 2, 0, 0);
      if (k == 0)
        odometry.push_back(truth);
      else
      {
        const CPose3D step = truth - poses.back();
        const double dx = camera.gauss(kPosition), dy = camera.gauss(kPosition);
        const double turn = camera.gauss(kAngle);
        odometry.push_back(
            odometry.back() + CPose3D(step.x() + dx, step.y() + dy, 0, step.yaw() + turn, 0, 0));
      }
      poses.push_back(truth);
      std::vector<TrueObject> near;
      for (const auto& object : objects)
        if ((object.object.center() - Eigen::Vector3d(truth.x(), truth.y(), 0)).norm() < kRange)
          near.push_back(object);
      auto boxes = CObservationObjects::Create(camera.observe(truth + T_robot_camera, near));
      boxes->sensorPose = T_robot_camera;
      measurements += boxes->objects.size();
      seen.push_back(boxes);
    }
  }

  std::optional<CPose3DPDFGaussian> step(std::size_t k) const
  {
    if (k == 0) return std::nullopt;
    CPose3DPDFGaussian step(odometry[k] - odometry[k - 1]);
    for (int i = 0; i < 3; ++i)
    {
      step.cov(i, i) = kPosition * kPosition;
      step.cov(i + 3, i + 3) = kAngle * kAngle;
    }
    return step;
  }

  static constexpr double kPosition = 0.01, kAngle = 0.001;  // per step [m], [rad]
  const CPose3D T_robot_camera{0, 0, 1.3, 0, 0.2, 0};
  std::vector<CPose3D> poses, odometry;
  std::vector<CObservationObjects::Ptr> seen;
  std::size_t measurements = 0;
};

double error(const Drive& drive, const std::vector<Keyframe>& keyframes)
{
  double worst = 0;
  for (std::size_t k = 0; k < keyframes.size(); ++k)
    worst = std::max(worst, keyframes[k].T_map_robot.distanceTo(drive.poses[k]));
  return worst;
}

}  // namespace

int main()
{
  const Drive drive;
  const LabelTable labels = LabelTable::installed();
  JointOptions options;
  options.rounds = kRounds;
  options.smallMove = 0;  // all rounds
  SlamResult result;
  result.map.setLabels(labels);
  JointBackEnd backEnd(options, result.map.insertionOptions, labels);
  std::printf("%d keyframes, %zu measurements\n", kKeyframes, drive.measurements);

  double start = cpu_s();
  for (std::size_t k = 0; k < drive.poses.size(); ++k)
  {
    const CPose3D& T_odom = drive.odometry[k];
    const CPose3D pose = backEnd.addKeyframe(T_odom, drive.step(k), drive.seen[k].get(), result);
    result.keyframes.push_back(
        {k, "camera", 0.1 * static_cast<double>(k), pose, T_odom, drive.step(k)});
    if ((k + 1) % 200 != 0) continue;
    std::printf("%4zu - %4zu: %.1f ms per keyframe\n", k - 199, k, 1000 * (cpu_s() - start) / 200);
    start = cpu_s();
  }
  start = cpu_s();
  backEnd.finish([&](std::size_t k) { return drive.seen[k]; }, result);
  std::printf(
      "%d rounds at the end: %.2f s; %zu objects; worst pose off by %.3f m, odometry %.3f m\n",
      result.correction->rounds, cpu_s() - start, result.map.confirmedObjects().size(),
      error(drive, result.keyframes), drive.odometry.back().distanceTo(drive.poses.back()));
  return 0;
}
