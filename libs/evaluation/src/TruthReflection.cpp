#include "quadmap/evaluation/TruthReflection.h"

#include <mrpt/poses/Lie/SO.h>

#include <algorithm>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/PoseReflection.h"

namespace quadmap
{
namespace
{
const Eigen::Vector3d kWorld(1, -1, 1);  // diagonal of its reflection
/** Those of a body with y down (optical), and of one with z up (a robot's): up is negated. */
const Eigen::Vector3d kOptical(1, -1, 1), kRobot(1, 1, -1);

/** The turns of a body between poses that are some way apart, as vectors [rad]. */
struct Turns
{
  std::vector<Eigen::Vector3d> truth, estimated;
};

Eigen::Vector3d turnBetween(const mrpt::poses::CPose3D& from, const mrpt::poses::CPose3D& to)
{
  return mrpt::poses::Lie::SO<3>::log((to - from).getRotationMatrix()).asEigen();
}

Turns turnsOf(const std::vector<PosePair>& pairs)
{
  constexpr std::size_t kSpans = 8;     // of the whole way, over which turns add up
  constexpr double kLargestTurn = 2.5;  // [rad]; a vector of a half turn has two directions
  const std::size_t span = std::max<std::size_t>(1, pairs.size() / kSpans);
  Turns turns;
  for (std::size_t i = 0; i + span < pairs.size(); ++i)
  {
    const PosePair &from = pairs[i], &to = pairs[i + span];
    const auto truth = turnBetween(from.T_truth_body, to.T_truth_body);
    if (truth.norm() > kLargestTurn) continue;
    turns.truth.push_back(truth);
    turns.estimated.push_back(turnBetween(from.T_estimated_body, to.T_estimated_body));
  }
  return turns;
}

/** Sum of squares of what is left when the estimated turns are brought into the true body [rad^2].
 */
double disagreement(const Turns& turns, const Eigen::Matrix3d& C)
{
  double sum = 0;
  for (std::size_t i = 0; i < turns.truth.size(); ++i)
    sum += (turns.truth[i] - C * turns.estimated[i]).squaredNorm();
  return sum;
}

}  // namespace

mrpt::poses::CPose3D TruthReflection::operator()(const mrpt::poses::CPose3D& T_truth_body) const
{
  return reflected(T_truth_body, kWorld, body_);
}

Ellipsoid TruthReflection::operator()(const Ellipsoid& object) const
{
  // An ellipsoid and its cuboid are their own mirror images, whichever axis is negated.
  return Ellipsoid(reflected(object.pose(), kWorld, kWorld), object.semiAxes());
}

namespace
{
/** Whether the estimated positions lie better on the true ones when these are reflected. */
bool alignsBetter(const std::vector<PosePair>& pairs, const TruthReflection& reflection)
{
  std::vector<PosePair> mirrored = pairs;
  for (auto& pair : mirrored) pair.T_truth_body = reflection(pair.T_truth_body);
  return ateRmse(mirrored, alignPositions(mirrored)) < ateRmse(pairs, alignPositions(pairs));
}

}  // namespace

std::optional<TruthReflection> reflectionOfTruth(const std::vector<PosePair>& pairs)
{
  constexpr double kClearlyBetter = 0.04;  // of squares: a fifth of the disagreement
  const Turns turns = turnsOf(pairs);
  const Eigen::Matrix3d C_optical_robot =
      T_sensor_optical().getRotationMatrix().asEigen().transpose();
  const double rightHanded = std::min(
      disagreement(turns, Eigen::Matrix3d::Identity()), disagreement(turns, C_optical_robot));
  const double robot = disagreement(turns, Eigen::Matrix3d((-kRobot).asDiagonal())),
               optical =
                   disagreement(turns, Eigen::Matrix3d((-kOptical).asDiagonal() * C_optical_robot));
  if (!(std::min(robot, optical) < kClearlyBetter * rightHanded)) return std::nullopt;
  const TruthReflection reflection(optical < robot ? kOptical : kRobot);
  // The turns are as well those of a right-handed body that is mounted half a turn about its
  // vertical axis, but then the positions are not mirrored.
  if (!alignsBetter(pairs, reflection)) return std::nullopt;
  return reflection;
}

}  // namespace quadmap
