#include "quadmap/estimation/ViewRedundancy.h"

#include <algorithm>

namespace quadmap
{
namespace
{
constexpr double kMinRange = 0.1;  // [m]
constexpr std::size_t kRememberedCameras = 200;

/** Sum of k_ij over some places, doc/mathematics.md, (16.20). */
template <typename Places>
double neighbours(
    const Eigen::Vector3d& camera,
    const Eigen::Vector3d& center,
    const Places& places,
    const ExistenceOptions& options)
{
  const double range = std::max(kMinRange, (center - camera).norm());
  const double reach = options.independentViewAngle * range;
  double sum = 0;
  for (const Eigen::Vector3d& place : places)
    sum += std::max(0.0, 1 - (place - camera).norm() / reach);
  return sum;
}

}  // namespace

std::vector<double> independentShares(
    const std::vector<Eigen::Vector3d>& cameras,
    const Eigen::Vector3d& center,
    const ExistenceOptions& options)
{
  std::vector<double> shares;
  const double rho = 1 - options.repeatedViewWeight;
  for (const auto& camera : cameras)  // each camera is among its own neighbours, with k = 1
    shares.push_back(1 / (1 + rho * (neighbours(camera, center, cameras, options) - 1)));
  return shares;
}

double independentShare(
    const Eigen::Vector3d& camera,
    const Eigen::Vector3d& center,
    const std::deque<Eigen::Vector3d>& earlier,
    const ExistenceOptions& options)
{
  const double rho = 1 - options.repeatedViewWeight;
  return 1 / (1 + rho * neighbours(camera, center, earlier, options));
}

void rememberCamera(const Eigen::Vector3d& camera, std::deque<Eigen::Vector3d>& cameras)
{
  cameras.push_back(camera);
  while (cameras.size() > kRememberedCameras) cameras.pop_front();
}

}  // namespace quadmap
