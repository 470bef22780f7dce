#include "FloorUp.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <vector>

#include "quadmap/odometry/UpDirection.h"
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

/** What images say about up in the world of the poses. */
struct UpVotes
{
  std::vector<Eigen::Vector3d> byFloor, bySurfaces;
};

UpVotes votesOf(const FrameFolder& folder)
{
  const PerceptionOptions options;
  const FramePerception perception(options, LabelTable());
  UpVotes votes;
  const std::size_t step = std::max<std::size_t>(1, folder.frames().size() / kImages);
  for (std::size_t i = 0; i < folder.frames().size(); i += step) try
    {
      const auto T_world_robot = folder.T_world_robot(i);
      if (!T_world_robot) continue;
      const Eigen::Matrix3d R_world_robot = T_world_robot->getRotationMatrix().asEigen();
      const auto scan = folder.scan(i);
      const auto floor = upOfFloor(perception, *scan);
      if (floor && isWithin(*floor, Eigen::Vector3d::UnitZ(), kFarthestTilt))
        votes.byFloor.push_back(R_world_robot * levelled(options, *scan, *floor));
      else if (const auto up = upOfSurfaces(options, *scan, Eigen::Vector3d::UnitZ()))
        votes.bySurfaces.push_back(R_world_robot * *up);
    }
    catch (const std::exception&)
    {
      // The import or the check meets the same error and reports it.
    }
  return votes;
}

/** Number of votes for the direction that most agree on. */
std::size_t countFor(const std::vector<Eigen::Vector3d>& votes, const Eigen::Vector3d& up)
{
  return static_cast<std::size_t>(std::count_if(
      votes.begin(), votes.end(), [&](const auto& v) { return isWithin(v, up, kAgreement); }));
}

/** The direction that most votes agree on, when these are enough. */
std::optional<Eigen::Vector3d> majority(const std::vector<Eigen::Vector3d>& votes)
{
  const auto up = agreedDirection(votes);
  if (!up) return {};
  const std::size_t count = countFor(votes, *up);
  return count < kFewestVotes || 2 * count < votes.size() ? std::nullopt : up;
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
  const UpVotes votes = votesOf(folder);
  if (const auto up = majority(votes.byFloor))
  {
    folder.turnUp(*up);
    return textOf(*up) + mrpt::format(
                             "by the floor in %zu images of %zu that show one",
                             countFor(votes.byFloor, *up), votes.byFloor.size());
  }
  if (const auto up = majority(votes.bySurfaces))
  {
    folder.turnUp(*up);
    return textOf(*up) + mrpt::format(
                             "by what is level and upright in %zu images of %zu without a floor",
                             countFor(votes.bySurfaces, *up), votes.bySurfaces.size());
  }
  return "taken as +z, as nothing says where it is and the images do not show the floor";
}

}  // namespace quadmap
