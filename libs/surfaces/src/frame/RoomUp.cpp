#include "quadmap/surfaces/RoomUp.h"

#include <cmath>

namespace quadmap
{
namespace
{
const double kStraight = std::sin(kPlaneAccuracy);
constexpr double kNearUp = M_SQRT1_2;  // cosine, of 45 degrees

/** The planes that agree with a direction. */
struct Agreement
{
  double share = 0;  // of the image's cells that they cover
  /** Sum of share n n^t, of vertical planes with the opposite sign. */
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();

  Agreement(const std::vector<ScenePlane>& planes, const Eigen::Vector3d& up)
  {
    for (const auto& plane : planes)
    {
      const Eigen::Vector3d& n = plane.plane.n;
      const bool isHorizontal = n.cross(up).norm() < kStraight;
      if (!isHorizontal && std::abs(n.dot(up)) > kStraight) continue;
      share += plane.share;
      moments += (isHorizontal ? plane.share : -plane.share) * n * n.transpose();
    }
  }

  /** The direction that fits them best, (15.11). */
  Eigen::Vector3d best(const Eigen::Vector3d& near) const
  {
    const Eigen::Vector3d up =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(2);
    return up.dot(near) < 0 ? Eigen::Vector3d(-up) : up;
  }
};

/** The normals of the planes, and what is at right angles with two of them. */
std::vector<Eigen::Vector3d> candidates(
    const std::vector<ScenePlane>& planes, const Eigen::Vector3d& guess)
{
  std::vector<Eigen::Vector3d> out;
  const auto add = [&](const Eigen::Vector3d& direction)
  {
    const double cosine = direction.dot(guess);
    if (std::abs(cosine) > kNearUp) out.push_back(cosine > 0 ? direction : -direction);
  };
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    add(planes[i].plane.n);
    for (std::size_t j = 0; j < i; ++j)
    {
      const Eigen::Vector3d along = planes[i].plane.n.cross(planes[j].plane.n);
      if (along.norm() > kNearUp) add(along.normalized());
    }
  }
  return out;
}

}  // namespace

std::optional<Eigen::Vector3d> upOfRoom(
    const std::vector<ScenePlane>& planes, const Eigen::Vector3d& guess)
{
  constexpr double kMinShare = 0.2;  // of the image
  std::optional<Eigen::Vector3d> up;
  double most = kMinShare;
  for (const auto& direction : candidates(planes, guess))
    if (const Agreement agreement(planes, direction); agreement.share > most)
    {
      most = agreement.share;
      up = agreement.best(direction);
    }
  return up;
}

}  // namespace quadmap
