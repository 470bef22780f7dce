#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap
{
namespace
{
constexpr double kMinHalfSize = 0.005;  // [m]
constexpr std::ptrdiff_t kFewCuboids = 3;

/** Mean direction of angles that mean the same every 90 degrees, doc/mathematics.md, (11.15). */
double commonYaw(const std::deque<ObjectView>& views)
{
  double c = 0, s = 0;
  bool anyDefined = false;
  for (const auto& v : views) anyDefined = anyDefined || (v.complete && v.yawDefined);
  for (const auto& v : views)
  {
    if (!v.complete || (anyDefined && !v.yawDefined)) continue;
    const double weight = v.yawDefined ? 1.0 / (v.yawSigma * v.yawSigma + 1e-4) : 1.0;
    c += weight * std::cos(4 * v.yaw);
    s += weight * std::sin(4 * v.yaw);
  }
  return std::atan2(s, c) / 4;
}

/** A place along a side's outward normal [m], and how strongly it pulls. */
struct Pull
{
  double position, weight;

  bool operator<(const Pull& other) const { return position < other.position; }
};

/** Where that share of all weights has been passed, or the middle of where it just has been and the
 * next; 0 without any. */
double weightedQuantile(std::vector<Pull> pulls, double share)
{
  constexpr double kRounding = 1e-9;  // of all weights
  std::sort(pulls.begin(), pulls.end());
  double all = 0;
  for (const Pull& pull : pulls) all += pull.weight;
  double left = share * all;
  for (std::size_t i = 0; i < pulls.size(); ++i)
  {
    left -= pulls[i].weight;
    if (left > kRounding * all) continue;
    const bool isPassed = left < -kRounding * all || i + 1 == pulls.size();
    if (isPassed || std::isinf(pulls[i + 1].position)) return pulls[i].position;
    return 0.5 * (pulls[i].position + pulls[i + 1].position);
  }
  return 0;
}

/** One side of an object, along its outward normal from a point near it: its measured ends, the
 * lower bounds, and where the cuboids end of which nothing else is known. */
class Side
{
 public:
  void add(double position, const FaceMeasurement& face)
  {
    auto& pulls = isEquality(face.kind)            ? ends_
                  : face.kind == FaceKind::AtLeast ? bounds_
                                                   : others_;
    pulls.push_back({position, 1 / face.sigma});
  }

  /** doc/mathematics.md, (11.26) [m]. */
  double position() const
  {
    constexpr double kBelieved = 0.75;  // of the bounds; what goes beyond is another thing
    if (ends_.empty() && bounds_.empty()) return weightedQuantile(others_, kBelieved);
    const double farthest = weightedQuantile(bounds_, kBelieved);
    if (ends_.empty()) return farthest;
    // The sum is least where the pulls from both sides are equal. A bound pulls outwards, from
    // wherever that is, until it is reached.
    std::vector<Pull> pulls;
    for (const auto& [end, weight] : ends_) pulls.push_back({end, 2 * weight});
    for (const auto& [bound, weight] : bounds_)
    {
      pulls.push_back({std::min(bound, farthest), weight});
      pulls.push_back({std::numeric_limits<double>::infinity(), weight});
    }
    return weightedQuantile(std::move(pulls), 0.5);
  }

 private:
  std::vector<Pull> ends_, bounds_, others_;
};

/** \param near A point near the object. About a point far from it, a view with a wrong yaw would
 * have its sides far from the others'. */
std::array<Side, kFaces> collectSides(
    const std::deque<ObjectView>& views, double yaw, const Eigen::Vector3d& near)
{
  std::array<Side, kFaces> sides;
  for (const auto& v : views)
  {
    if (!v.complete) continue;
    // The measured face f is side `turned` of a cuboid at `yaw`.
    const int quarter = -quarterTurnsTo(v.yaw, yaw);
    static constexpr std::array<std::size_t, 4> kAround{0, 2, 1, 3};  // +x, +y, -x, -y
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      std::size_t turned = f;
      if (f < 4)
      {
        const auto at = std::find(kAround.begin(), kAround.end(), f) - kAround.begin();
        turned = kAround[static_cast<std::size_t>(((at + quarter) % 4 + 4) % 4)];
      }
      const double position = v.faceOffset(f) - v.faceNormal(f).dot(near);
      sides[turned].add(position, v.faces[f]);
    }
  }
  return sides;
}

/** Median of the centres of the views whose depth is the object's; of all views when there is none.
 */
Eigen::Vector3d medianOfCenters(const std::deque<ObjectView>& views)
{
  const bool anyOwn =
      std::any_of(views.begin(), views.end(), [](const auto& v) { return v.hasOwnDepth; });
  Eigen::Vector3d center;
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    std::vector<double> values;
    for (const auto& v : views)
      if (v.hasOwnDepth || !anyOwn) values.push_back(v.center[i]);
    center[i] = median(values);
  }
  return center;
}

UprightState medianOfPartial(const std::deque<ObjectView>& views, const LabelProperties& label)
{
  UprightState x = UprightState::Zero();
  x.head<3>() = medianOfCenters(views);
  x.tail<3>() = (0.5 * label.typicalSize).array().log();
  return x;
}

}  // namespace

std::optional<UprightState> medianState(
    const std::deque<ObjectView>& views, const LabelProperties& label)
{
  if (views.empty()) return {};
  const auto complete =
      std::count_if(views.begin(), views.end(), [](const auto& v) { return v.complete; });
  if (complete == 0) return medianOfPartial(views, label);

  UprightState x = UprightState::Zero();
  x[3] = commonYaw(views);
  const Eigen::Vector3d near = medianOfCenters(views);
  x.head<3>() = near;
  const auto sides = collectSides(views, x[3], near);
  ObjectView frame;  // for its face normals at the common yaw
  frame.yaw = x[3];
  for (std::size_t axis = 0; axis < 3; ++axis)  // (11.16)
  {
    const double plus = sides[2 * axis].position(), minus = sides[2 * axis + 1].position();
    x.head<3>() += 0.5 * (plus - minus) * frame.faceNormal(2 * axis);
    x[4 + static_cast<Eigen::Index>(axis)] = std::log(std::max(0.5 * (plus + minus), kMinHalfSize));
  }
  // One or two cuboids among many that fitted none do not say where the object is.
  if (complete < kFewCuboids && 2 * complete < static_cast<std::ptrdiff_t>(views.size()))
    x.head<3>() = near;
  return x;
}

}  // namespace quadmap
