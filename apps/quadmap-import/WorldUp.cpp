#include "WorldUp.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <exception>
#include <vector>

#include "quadmap/odometry/UpDirection.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kImages = 40;  // that are looked at

/** What images say about up in the world of the poses. */
struct UpsSeen
{
  std::vector<Eigen::Vector3d> byFloor, bySurfaces;
};

UpsSeen upsSeenIn(const FrameFolder& folder)
{
  const UpFinder finder{PerceptionOptions()};
  UpsSeen seen;
  const std::size_t step = std::max<std::size_t>(1, folder.frames().size() / kImages);
  for (std::size_t i = 0; i < folder.frames().size(); i += step) try
    {
      const auto T_world_robot = folder.T_world_robot(i);
      if (!T_world_robot) continue;
      const auto up = finder.find(*folder.scan(i), Eigen::Vector3d::UnitZ());
      if (!up) continue;
      (up->origin == UpOrigin::Floor ? seen.byFloor : seen.bySurfaces)
          .push_back(T_world_robot->getRotationMatrix().asEigen() * up->up_robot);
    }
    catch (const std::exception&)
    {
      // The import or the check meets the same error and reports it.
    }
  return seen;
}

std::string textOf(const Eigen::Vector3d& up)
{
  return mrpt::format("(%.3f, %.3f, %.3f) in the world of the poses, ", up.x(), up.y(), up.z());
}

}  // namespace

std::string turnUpright(FrameFolder& folder)
{
  if (folder.posesCount() == 0) return "left to quadmap-slam, as there are no poses";
  const FolderCamera& camera = folder.camera();
  if (const auto& up = camera.worldUp)
    return textOf(*up) + "as " + (camera.upOrigin.empty() ? camera.origin : camera.upOrigin) +
           " says";
  const UpsSeen seen = upsSeenIn(folder);
  const auto floor = agreedDirection(seen.byFloor);
  if (floor && floor->isMajorityOf(seen.byFloor.size()))
  {
    folder.turnUp(floor->direction);
    return textOf(floor->direction) + mrpt::format(
                                          "by the floor in %zu images of %zu that show one",
                                          floor->votes, seen.byFloor.size());
  }
  const auto surfaces = agreedDirection(seen.bySurfaces);
  if (surfaces && surfaces->isMajorityOf(seen.bySurfaces.size()))
  {
    folder.turnUp(surfaces->direction);
    return textOf(surfaces->direction) +
           mrpt::format(
               "by horizontal and vertical surfaces in %zu images of %zu without a floor",
               surfaces->votes, seen.bySurfaces.size());
  }
  return "taken as +z, as nothing says where it is, nor do enough images show it";
}

}  // namespace quadmap
