#include "quadmap/odometry/ImpossibleSteps.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/poses/Lie/SO.h>

#include <cmath>
#include <utility>

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
constexpr double kFastest = 4.0;           // a runner, twice a fast robot indoors [m/s]
constexpr double kFastestTurn = 2 * M_PI;  // faster than hands turn a camera [rad/s]
// A localisation that serves as odometry corrects itself now and then.
constexpr double kCorrection = 0.3;      // [m]
constexpr double kTurnCorrection = 0.5;  // [rad]
}  // namespace

void ImpossibleSteps::add(const RgbdFrame& frame, const CPose3D& T_map_robot)
{
  const auto before = std::exchange(last_, Pose{frame.time(), T_map_robot});
  if (!before) return;
  const double seconds = std::abs(frame.time() - before->time);
  const CPose3D step = T_map_robot - before->T_map_robot;
  const double moved = step.norm();
  const double turned = mrpt::poses::Lie::SO<3>::log(step.getRotationMatrix()).norm();
  if (moved <= kCorrection + kFastest * seconds &&
      turned <= kTurnCorrection + kFastestTurn * seconds)
    return;
  if (count_++ == 0)
    first_ = mrpt::format(
        "%.2f m and %.0f degrees in %.3f s before record %zu (%s)", moved, mrpt::RAD2DEG(turned),
        seconds, frame.record, frame.scan->sensorLabel.c_str());
}

std::string ImpossibleSteps::warning() const
{
  if (count_ == 0) return {};
  return mrpt::format(
      "the given poses jump as no robot does, first by %s (%zu in all): poses and objects are "
      "doubtful",
      first_.c_str(), count_);
}

}  // namespace quadmap
