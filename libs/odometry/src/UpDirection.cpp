#include "quadmap/odometry/UpDirection.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/surfaces/RoomUp.h"
#include "visual/RigidMotion.h"

namespace quadmap
{
namespace
{
const double kAgreement = std::cos(5 * M_PI / 180);  // accuracy of the planes of a depth camera
}

std::optional<Eigen::Vector3d> upOfFloor(
    const FramePerception& perception, const mrpt::obs::CObservation3DRangeScan& scan)
{
  CObservationObjects noBoxes;
  const auto surfaces = perception.measure(scan, noBoxes, std::nullopt);
  const auto floor = std::find_if(
      surfaces.seen.begin(), surfaces.seen.end(),
      [](const SurfacePatch& patch) { return patch.kind == SurfaceKind::Floor; });
  if (floor == surfaces.seen.end()) return std::nullopt;
  return isometryOf(scan.sensorPose).linear() * floor->plane.n;
}

std::optional<Eigen::Vector3d> upOfSurfaces(
    const PerceptionOptions& options,
    const mrpt::obs::CObservation3DRangeScan& scan,
    const Eigen::Vector3d& guess)
{
  const Eigen::Matrix3d R_robot_optical =
      (isometryOf(scan.sensorPose) * isometryOf(T_sensor_optical())).linear();
  const DepthCloud cloud(scan, options);
  const auto up =
      upOfRoom(segmentPlanes(cloud, options).planes, R_robot_optical.transpose() * guess);
  if (!up) return std::nullopt;
  return R_robot_optical * *up;
}

Eigen::Vector3d levelled(
    const PerceptionOptions& options,
    const mrpt::obs::CObservation3DRangeScan& scan,
    const Eigen::Vector3d& up_robot)
{
  const auto better = upOfSurfaces(options, scan, up_robot);
  return better && better->dot(up_robot) > kAgreement ? *better : up_robot;
}

std::optional<Eigen::Vector3d> agreedDirection(const std::vector<Eigen::Vector3d>& directions)
{
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  int mostVotes = 0;
  for (const auto& candidate : directions)
  {
    int votes = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& other : directions)
      if (candidate.dot(other) > kAgreement)
      {
        sum += other;
        ++votes;
      }
    if (votes <= mostVotes) continue;
    mostVotes = votes;
    best = sum.normalized();
  }
  if (mostVotes == 0) return std::nullopt;
  return best;
}

}  // namespace quadmap
