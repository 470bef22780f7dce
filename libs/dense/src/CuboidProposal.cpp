#include "quadmap/dense/CuboidProposal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

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

/** Squares of a plan that points cover. */
std::size_t coveredSquares(
    const DenseCloud& cloud, const std::function<bool(const DensePoint&)>& is)
{
  constexpr float kSquare = 0.015F;  // [m], so that cells of objects cover it whole
  std::set<std::pair<int, int>> squares;
  for (const DensePoint& point : cloud)
    if (is(point))
      squares.insert(
          {static_cast<int>(std::floor(point.position.x() / kSquare)),
           static_cast<int>(std::floor(point.position.y() / kSquare))});
  return squares.size();
}

/** A level surface that most of the plan of an object lies under. */
struct LevelTop
{
  float height = 0;  //!< [m]
  double above = 0;  //!< Share of the plan that points above it cover
};

std::optional<LevelTop> levelTopOf(const DenseCloud& cloud)
{
  constexpr float kFacing = 0.9F, kWithin = 0.01F;  // of normals' z; of heights [m]
  constexpr double kCovered = 0.6;                  // share of the plan
  std::vector<float> heights;
  for (const DensePoint& point : cloud)
    if (point.normal.z() > kFacing) heights.push_back(point.position.z());
  if (heights.size() < kFewestPoints) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  std::size_t middle = 0, most = 0;
  for (std::size_t i = 0, end = 0; i < heights.size(); ++i)
  {
    while (end < heights.size() && heights[end] <= heights[i] + kWithin) ++end;
    if (end - i <= most) continue;
    most = end - i;
    middle = i + most / 2;
  }
  const float top = heights[middle];
  const auto covered = [&](const auto& is)
  { return static_cast<double>(coveredSquares(cloud, is)); };
  const double all = covered([](const DensePoint&) { return true; });
  const double level =
      covered([&](const DensePoint& p)
              { return p.normal.z() > kFacing && std::abs(p.position.z() - top) < kWithin; });
  if (level < kCovered * all) return std::nullopt;
  return LevelTop{
      top, covered([&](const DensePoint& p) { return p.position.z() > top + kWithin; }) / all};
}

/** Only the points up to a height [m]. */
DenseCloud below(const DenseCloud& cloud, float height)
{
  DenseCloud kept;
  for (const DensePoint& point : cloud)
    if (point.position.z() <= height) kept.push_back(point);
  return kept;
}

/** Whether other things are at a side of the cuboid. */
bool isTouched(const ObjectPoints& object, const Ellipsoid& cuboid, int axis, double sign)
{
  constexpr double kGap = 0.015, kInside = 0.01;          // from the side, outwards and inwards [m]
  constexpr double kAboveBottom = 0.015;                  // [m], as supports scatter
  constexpr double kMostPoints = 20, kMostShare = 0.002;  // of the object's, may be noise
  const Eigen::Matrix3d R = cuboid.rotation();
  const Eigen::Vector3d half = cuboid.semiAxes();
  const int along = axis == 0 ? 1 : 0;
  const auto isAtSide = [&](const Eigen::Vector3f& position)
  {
    const Eigen::Vector3d p = R.transpose() * (position.cast<double>() - cuboid.center());
    const double beyond = sign * p[axis] - half[axis];
    return beyond > -kInside && beyond < kGap && std::abs(p[along]) < half[along] &&
           p.z() > kAboveBottom - half.z() && p.z() < half.z();
  };
  const auto atSide = std::count_if(object.others.begin(), object.others.end(), isAtSide);
  const double most = std::max(kMostPoints, kMostShare * static_cast<double>(object.cloud.size()));
  return static_cast<double>(atSide) > most;
}

}  // namespace

bool CuboidProposal::fullySeen() const
{
  const auto holds = [](bool is) { return is; };
  return std::all_of(seen.begin(), seen.end(), holds) &&
         std::none_of(touched.begin(), touched.end(), holds);
}

std::optional<CuboidProposal> proposeCuboid(const ObjectPoints& object, const LabelTable& labels)
{
  if (object.cloud.size() < kFewestPoints) return std::nullopt;
  constexpr float kScatter = 0.006F;  // of the points of a plane [m]
  constexpr double kOwnPart = 0.1;    // of the plan: backs of chairs have more
  const auto top = levelTopOf(object.cloud);
  const bool isLevel = top && labels.properties(object.record.label).levelTop;
  const DenseCloud cloud = isLevel ? below(object.cloud, top->height + kScatter) : object.cloud;
  const double yaw = headingOf(planOf(cloud, 6000), object.record.orientationDefined);
  const auto plan = planOf(cloud, cloud.size());
  const Interval x = extentAlong(plan, yaw), y = extentAlong(plan, yaw + M_PI / 2);
  std::vector<double> heights;
  for (const DensePoint& point : cloud) heights.push_back(point.position.z());
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
  const bool hasSomethingOnTop = top && !isLevel && top->above > 0 && top->above < kOwnPart &&
                                 z.high > static_cast<double>(top->height + kScatter);
  proposal.seen[4] = 2 * object.boxesWithTop >= object.eyes.size() && !hasSomethingOnTop;
  for (std::size_t side = 0; side < 4; ++side)
  {
    const int axis = static_cast<int>(side / 2);
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    proposal.seen[side] = isSeen(object, proposal.record.object, axis, sign);
    proposal.touched[side] = isTouched(object, proposal.record.object, axis, sign);
  }
  return proposal;
}

}  // namespace quadmap
