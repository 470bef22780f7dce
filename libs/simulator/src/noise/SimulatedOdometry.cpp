#include "noise/SimulatedOdometry.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/poses/Lie/SO.h>

#include <cmath>

namespace quadmap::simulator
{
namespace
{
/** Angle of a rotation [rad]. */
double angleOf(const mrpt::poses::CPose3D& pose)
{
  return mrpt::poses::Lie::SO<3>::log(pose.getRotationMatrix()).norm();
}

/** Standard deviations of each axis of one step [m], [rad]. The variances grow with the way, so
 * that the drift does not depend on the frame rate. */
struct StepSigma
{
  double translation, rotation;
};

StepSigma sigmaOf(const OdometryOptions& o, double metres, double radians)
{
  const double perMetre = std::sqrt(metres), perRadian = std::sqrt(radians);
  return {
      std::hypot(o.translationPerMetre * perMetre, o.translationPerRadian * perRadian),
      mrpt::DEG2RAD(
          std::hypot(o.rotationPerMetre_deg * perMetre, o.rotationPerRadian_deg * perRadian))};
}

}  // namespace

std::vector<mrpt::poses::CPose3D> driftingOdometry(
    const std::vector<mrpt::poses::CPose3D>& T_world_robot,
    const OdometryOptions& options,
    RandomStream& random)
{
  std::vector<mrpt::poses::CPose3D> drifted;
  const double scale = 1 + options.scale * random.gaussian();
  for (std::size_t i = 0; i < T_world_robot.size(); ++i)
  {
    if (i == 0)
    {
      drifted.push_back(T_world_robot[0]);
      continue;
    }
    mrpt::poses::CPose3D step = T_world_robot[i] - T_world_robot[i - 1];
    const StepSigma sigma = sigmaOf(options, step.norm(), angleOf(step));
    for (unsigned k = 0; k < 3; ++k)
      step.m_coords[k] = scale * step.m_coords[k] + sigma.translation * random.gaussian();
    const double yaw = sigma.rotation * random.gaussian();
    const double pitch = sigma.rotation * random.gaussian();
    const double roll = sigma.rotation * random.gaussian();
    drifted.push_back(drifted.back() + step + mrpt::poses::CPose3D(0, 0, 0, yaw, pitch, roll));
  }
  return drifted;
}

}  // namespace quadmap::simulator
