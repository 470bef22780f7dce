#include "quadmap/dense/CuboidProposal.h"

#include <algorithm>
#include <cmath>

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kFewestPoints = 50;
constexpr double kLeastHalfLength = 0.001;  // [m]; a file of proposals has four decimals

struct Interval
{
  double low = 0, high = 0;
  double length() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
};

/** Where values end, without the few that lie farthest out on either side: equation (22.2). */
Interval endsOf(std::vector<double>& values)
{
  constexpr double kTrimmed = 0.002;  // share on each side
  const auto trimmed = std::max<std::size_t>(
      1, static_cast<std::size_t>(kTrimmed * static_cast<double>(values.size())));
  const auto at = [&](std::size_t i)
  {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values.end());
    return values[i];
  };
  return {at(trimmed), at(values.size() - 1 - trimmed)};
}

Interval extentAlong(const std::vector<Eigen::Vector2d>& plan, double angle)
{
  const Eigen::Vector2d axis(std::cos(angle), std::sin(angle));
  std::vector<double> values;
  values.reserve(plan.size());
  for (const Eigen::Vector2d& p : plan) values.push_back(axis.dot(p));
  return endsOf(values);
}

double area(const std::vector<Eigen::Vector2d>& plan, double yaw)
{
  return extentAlong(plan, yaw).length() * extentAlong(plan, yaw + M_PI / 2).length();
}

double width(const std::vector<Eigen::Vector2d>& plan, double yaw)
{
  return std::min(extentAlong(plan, yaw).length(), extentAlong(plan, yaw + M_PI / 2).length());
}

/** The heading of a rectangle around a plan, in [0, pi/2): that of least area or, where the object
 * has no heading of its own, of least width, as a cup that is longer by its handle: (22.3). */
double headingOf(const std::vector<Eigen::Vector2d>& plan, bool orientationDefined)
{
  const auto measure = orientationDefined ? area : width;
  constexpr double kCoarse = fromDegrees(2), kFine = fromDegrees(0.25);
  double best = 0, least = measure(plan, 0);
  const auto tryYaw = [&](double yaw)
  {
    const double value = measure(plan, yaw);
    if (value >= least) return;
    least = value;
    best = yaw;
  };
  for (int i = 1; i < 45; ++i) tryYaw(i * kCoarse);
  const double coarse = best;
  for (int i = -8; i <= 8; ++i) tryYaw(coarse + i * kFine);
  return best;
}

/** At most about so many of the points, evenly chosen. */
std::vector<Eigen::Vector2d> planOf(const DenseCloud& cloud, std::size_t most)
{
  const std::size_t step = (cloud.size() + most - 1) / most;
  std::vector<Eigen::Vector2d> plan;
  for (std::size_t i = 0; i < cloud.size(); i += step)
    plan.push_back(cloud[i].position.head<2>().cast<double>());
  return plan;
}

/** Whether an upright side of the cuboid was looked at: some camera stood before it, and points
 * that face the same way lie along it. \param axis, sign Which side of `cuboid`. */
bool isSeen(const ObjectPoints& object, const Ellipsoid& cuboid, int axis, double sign)
{
  constexpr double kFacing = 0.6;  // of the normal along that of the side
  constexpr int kBins = 10;        // along the side
  constexpr int kMostBins = 7;     // with points that face its way
  const Eigen::Matrix3d R = cuboid.rotation();
  const Eigen::Vector3d half = cuboid.semiAxes();
  const auto beyond = [&](const Eigen::Vector3d& p)
  { return sign * R.col(axis).dot(p - cuboid.center()) - half[axis]; };
  const auto before = std::count_if(
      object.eyes.begin(), object.eyes.end(),
      [&](const Eigen::Vector3d& eye) { return beyond(eye) > 0.1; });
  if (before < 3) return false;
  const double nearSide = 0.02 + 0.25 * half[axis];
  const int along = axis == 0 ? 1 : 0;
  std::array<bool, kBins> bins{};
  for (const DensePoint& point : object.cloud)
  {
    const Eigen::Vector3d p = point.position.cast<double>();
    if (sign * R.col(axis).dot(point.normal.cast<double>()) < kFacing || beyond(p) < -nearSide)
      continue;
    const double share = 0.5 + 0.5 * R.col(along).dot(p - cuboid.center()) / half[along];
    bins[static_cast<std::size_t>(std::clamp(static_cast<int>(kBins * share), 0, kBins - 1))] =
        true;
  }
  return std::count(bins.begin(), bins.end(), true) >= kMostBins;
}

}  // namespace

bool CuboidProposal::fullySeen() const
{
  return std::all_of(seen.begin(), seen.end(), [](bool side) { return side; });
}

std::optional<CuboidProposal> proposeCuboid(const ObjectPoints& object)
{
  if (object.cloud.size() < kFewestPoints) return std::nullopt;
  const double yaw = headingOf(planOf(object.cloud, 6000), object.record.orientationDefined);
  const auto plan = planOf(object.cloud, object.cloud.size());
  const Interval x = extentAlong(plan, yaw), y = extentAlong(plan, yaw + M_PI / 2);
  std::vector<double> heights;
  for (const DensePoint& point : object.cloud) heights.push_back(point.position.z());
  Interval z = endsOf(heights);
  if (object.supportHeight) z.low = std::min(*object.supportHeight, z.high - 0.002);

  const Eigen::Vector3d half =
      (0.5 * Eigen::Vector3d(x.length(), y.length(), z.length())).cwiseMax(kLeastHalfLength);
  const Eigen::Rotation2Dd R(yaw);
  const Eigen::Vector2d center = R * Eigen::Vector2d(x.middle(), y.middle());
  CuboidProposal proposal;
  proposal.record.id = object.record.id;
  proposal.record.label = object.record.label;
  proposal.record.orientationDefined = object.record.orientationDefined;
  proposal.record.object =
      Ellipsoid(mrpt::poses::CPose3D(center.x(), center.y(), z.middle(), yaw, 0, 0), half);
  proposal.points = object.cloud.size();
  proposal.seen[4] = 2 * object.boxesWithTop >= object.eyes.size();
  for (std::size_t side = 0; side < 4; ++side)
    proposal.seen[side] = isSeen(
        object, proposal.record.object, static_cast<int>(side / 2), side % 2 == 0 ? 1.0 : -1.0);
  return proposal;
}

}  // namespace quadmap
