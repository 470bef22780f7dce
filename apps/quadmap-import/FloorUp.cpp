#include "FloorUp.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kImages = 40;   // in which the floor is looked for
constexpr double kFarthestTilt = 60;  // of the camera; a wall may be mistaken for the floor [deg]
constexpr double kAgreement = 5;      // of floors, as the planes of depth cameras are [deg]
constexpr std::size_t kFewestVotes = 3;

bool isWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double degrees)
{
  return a.dot(b) > std::cos(degrees * M_PI / 180);
}

/** What the images that show a floor say about up in the world of the poses. */
std::vector<Eigen::Vector3d> floorsIn(const FrameFolder& folder)
{
  const FramePerception perception({}, LabelTable());
  std::vector<Eigen::Vector3d> ups;
  const std::size_t step = std::max<std::size_t>(1, folder.frames().size() / kImages);
  for (std::size_t i = 0; i < folder.frames().size(); i += step) try
    {
      const auto T_world_robot = folder.T_world_robot(i);
      if (!T_world_robot) continue;
      const auto up_robot = upOfFloor(perception, *folder.scan(i));
      if (up_robot && isWithin(*up_robot, Eigen::Vector3d::UnitZ(), kFarthestTilt))
        ups.push_back(T_world_robot->getRotationMatrix().asEigen() * *up_robot);
    }
    catch (const std::exception&)
    {
      // The import or the check meets the same error and reports it.
    }
  return ups;
}
}  // namespace

std::string turnUpright(FrameFolder& folder)
{
  if (folder.posesCount() == 0) return "left to quadmap-slam, as there are no poses";
  const FolderCamera& camera = folder.camera();
  if (const auto& up = camera.worldUp)
    return mrpt::format(
        "(%.3f, %.3f, %.3f) in the world of the poses, as %s says", up->x(), up->y(), up->z(),
        (camera.upOrigin.empty() ? camera.origin : camera.upOrigin).c_str());
  const auto floors = floorsIn(folder);
  const auto up = agreedDirection(floors);
  const auto votes = static_cast<std::size_t>(std::count_if(
      floors.begin(), floors.end(), [&](const auto& f) { return isWithin(f, *up, kAgreement); }));
  if (votes < kFewestVotes || 2 * votes < floors.size())
    return "taken as +z, as nothing says where it is and the images do not show the floor";
  folder.turnUp(*up);
  return mrpt::format(
      "(%.3f, %.3f, %.3f) in the world of the poses, by the floor in %zu images of %zu that show "
      "one",
      up->x(), up->y(), up->z(), votes, floors.size());
}

}  // namespace quadmap
