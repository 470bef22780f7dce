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
double crowdOf(
    const Eigen::Vector3d& camera,
    const Eigen::Vector3d& center,
    const Places& places,
    const ExistenceOptions& options)
{
  const double reach = independentReach(camera, center, options);
  double sum = 0;
  for (const Eigen::Vector3d& place : places) sum += sharedMistakes(place, camera, reach);
  return sum;
}

}  // namespace

double independentReach(
    const Eigen::Vector3d& camera, const Eigen::Vector3d& center, const ExistenceOptions& options)
{
  return options.independentViewAngle * std::max(kMinRange, (center - camera).norm());
}

double sharedMistakes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach)
{
  return std::max(0.0, 1 - (a - b).norm() / reach);
}

double independentShare(double crowd, const ExistenceOptions& options)
{
  return 1 / (1 + (1 - options.repeatedViewWeight) * crowd);
}

std::vector<double> independentShares(
    const std::vector<Eigen::Vector3d>& cameras,
    const Eigen::Vector3d& center,
    const ExistenceOptions& options)
{
  std::vector<double> shares;
  for (const auto& camera : cameras)  // each camera is among its own neighbours, with k = 1
    shares.push_back(independentShare(crowdOf(camera, center, cameras, options) - 1, options));
  return shares;
}

double independentShare(
    const Eigen::Vector3d& camera,
    const Eigen::Vector3d& center,
    const std::deque<Eigen::Vector3d>& earlier,
    const ExistenceOptions& options)
{
  return independentShare(crowdOf(camera, center, earlier, options), options);
}

void rememberCamera(const Eigen::Vector3d& camera, std::deque<Eigen::Vector3d>& cameras)
{
  cameras.push_back(camera);
  while (cameras.size() > kRememberedCameras) cameras.pop_front();
}

}  // namespace quadmap
