#include "quadmap/odometry/UpDirection.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/surfaces/RoomUp.h"
#include "visual/RigidMotion.h"

namespace quadmap
{
namespace
{
const double kAgreement = std::cos(kPlaneAccuracy);
const double kFarthest = std::cos(60 * M_PI / 180.0);  // a floor's normal from the guess

/** The normal of the plane on which everything in an image stands, in the robot's frame. It is
 * nothing when the image shows none. */
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

/** Up by horizontal and vertical surfaces, see upOfRoom(), in the robot's frame. */
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

}  // namespace

UpFinder::UpFinder(const PerceptionOptions& options) :
    options_(options), perception_(options, LabelTable())
{
}

std::optional<SeenUp> UpFinder::find(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const Eigen::Vector3d& guess,
    BelievedFloors floors) const
{
  const auto floor = upOfFloor(perception_, scan);
  const double cosine = floor ? floor->dot(guess) : 0.0;
  const bool isBelieved =
      floors == BelievedFloors::Below ? cosine > kFarthest : std::abs(cosine) > kFarthest;
  const auto up = upOfSurfaces(options_, scan, isBelieved ? *floor : guess);
  // One plane of a depth image is wrong by a degree or two, and all surfaces together by less.
  if (isBelieved) return SeenUp{up && up->dot(*floor) > kAgreement ? *up : *floor, UpOrigin::Floor};
  if (!up) return std::nullopt;
  return SeenUp{*up, UpOrigin::Surfaces};
}

std::optional<AgreedDirection> agreedDirection(const std::vector<Eigen::Vector3d>& directions)
{
  AgreedDirection best;
  for (const auto& candidate : directions)
  {
    std::size_t votes = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& other : directions)
      if (candidate.dot(other) > kAgreement)
      {
        sum += other;
        ++votes;
      }
    if (votes > best.votes) best = {sum.normalized(), votes};
  }
  if (best.votes == 0) return std::nullopt;
  return best;
}

}  // namespace quadmap
