#include "KnownObjects.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr double kKernel = 4.3;       // chi of seven degrees of freedom, 99 %: it may have moved
constexpr double kAnyYaw = 2 * M_PI;  // sigma of a yaw that means nothing [rad]

struct Known
{
  UprightState state;
  UprightCovariance covariance;
};

/** A cuboid has four upright states: the one whose yaw is nearest. */
Known namedLike(Known known, double yaw)
{
  const double turns = std::round((yaw - known.state[3]) / (M_PI / 2));
  known.state[3] += turns * M_PI / 2;
  if (std::fmod(std::abs(turns), 2) < 0.5) return known;
  Eigen::PermutationMatrix<7> swapAxes;
  swapAxes.setIdentity();
  std::swap(swapAxes.indices()[4], swapAxes.indices()[5]);
  known.state = swapAxes * known.state;
  known.covariance = swapAxes * known.covariance * swapAxes.transpose();
  return known;
}

ObjectPrior priorOf(const MapObject& local, const MapObject& given, double sigma)
{
  const double yaw = uprightStateOf(local.object)[3];
  Known known = namedLike({uprightStateOf(given.object), given.covariance}, yaw);
  const bool hasHeading = local.orientationDefined && given.orientationDefined;
  if (!hasHeading) known.state[3] = yaw;
  // The sides err by sigma, each for itself: ln s by sigma / s, yaw as along the longer side.
  UprightState more;
  more.head<3>().setConstant(sigma);
  more.tail<3>() = sigma * (-known.state.tail<3>()).array().exp();
  more[3] = hasHeading ? std::min(more[4], more[5]) : kAnyYaw;
  known.covariance += UprightCovariance(more.cwiseAbs2().asDiagonal());
  const UprightCovariance L = known.covariance.inverse();
  ObjectPrior prior;
  Eigen::Map<UprightState>(prior.at.data()) = known.state;
  prior.L = 0.5 * (L + L.transpose());
  prior.g = Eigen::VectorXd::Zero(7);
  prior.cauchy = kKernel;
  return prior;
}

}  // namespace

std::map<ObjectId, ObjectPrior> priorsOf(
    const CQuadricObjectMap& local,
    const CQuadricObjectMap& given,
    const std::vector<std::pair<ObjectId, ObjectId>>& pairs,
    const RelocalizationOptions& options)
{
  std::map<ObjectId, ObjectPrior> priors;
  for (const auto& [here, there] : pairs)
    priors[here] = priorOf(*local.find(here), *given.find(there), options.mapSigma);
  return priors;
}

}  // namespace quadmap
