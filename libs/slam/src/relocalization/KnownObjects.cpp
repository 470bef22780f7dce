#include "KnownObjects.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/AxisRenaming.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
namespace
{
constexpr double kAnyYaw = 2 * M_PI;  // sigma of a yaw that means nothing [rad]

struct Known
{
  UprightState state;
  UprightCovariance covariance;
};

Known renamed(const Known& known, const AxisRenaming& by)
{
  return {by.state(known.state), by.matrix(known.covariance)};
}

/** Names the axes when there is no heading: the longer horizontal axis tells which is which. */
Known shapedLike(Known known, const UprightState& local)
{
  if ((known.state[4] - known.state[5]) * (local[4] - local[5]) < 0)
    known = renamed(known, axisRenaming(1));
  known.state[3] = local[3];
  return known;
}

}  // namespace

ObjectPrior priorOf(const MapObject& local, const MapObject& given, double sigma)
{
  const UprightState here = uprightStateOf(local.object);
  const Known there{uprightStateOf(given.object), given.covariance};
  const bool hasHeading = local.orientationDefined && given.orientationDefined;
  Known known =
      hasHeading ? renamed(there, axisRenaming(there.state, here)) : shapedLike(there, here);
  // (19.7): each side errs by sigma for itself, ln s by sigma / s and the yaw as along the longer
  // side.
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
  prior.cauchy = kObjectKernel;
  return prior;
}

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
