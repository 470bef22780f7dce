#include "PlaneLevel.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr std::size_t kMinPoints = 10;
constexpr double kUpSigma = 0.012;   // of `up`: poses of a robot or a hand-held camera [rad]
constexpr double kIndependent = 20;  // samples of a patch: a depth camera's errors are correlated

struct Heights
{
  std::vector<double> along;   // of the points along a direction [m]
  std::vector<double> sigmas;  // of them [m]
};

Heights heightsAlong(
    const std::vector<Eigen::Vector3d>& points,
    const Eigen::Vector3d& direction,
    const PerceptionOptions& options)
{
  constexpr double kFlatness = 0.001;  // of real surfaces [m]
  Heights out;
  for (const auto& p : points)
  {
    out.along.push_back(direction.dot(p));
    const double perDepth = direction.dot(p) / p.z();  // errors lie along the ray
    out.sigmas.push_back(std::hypot(kFlatness, perDepth * options.depthSigma(p.z())));
  }
  return out;
}

/** The height that most points agree with within two of their sigmas. */
double mode(const Heights& heights)
{
  struct End
  {
    double height;
    int step;
  };
  std::vector<End> ends;
  for (std::size_t i = 0; i < heights.along.size(); ++i)
  {
    ends.push_back({heights.along[i] - 2 * heights.sigmas[i], 1});
    ends.push_back({heights.along[i] + 2 * heights.sigmas[i], -1});
  }
  std::sort(
      ends.begin(), ends.end(),
      [](const End& a, const End& b)
      { return a.height != b.height ? a.height < b.height : a.step > b.step; });
  int depth = 0, deepest = 0;
  double from = 0, to = 0;
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    depth += ends[i].step;
    if (depth <= deepest) continue;
    deepest = depth;
    from = ends[i].height;
    to = i + 1 < ends.size() ? ends[i + 1].height : from;
  }
  return 0.5 * (from + to);
}

/** Points within 2.5 sigmas of a plane. */
std::vector<std::size_t> pointsOn(
    const Plane& plane, const std::vector<Eigen::Vector3d>& points, const Heights& heights)
{
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(plane.signedDistance(points[i])) < 2.5 * heights.sigmas[i]) out.push_back(i);
  return out;
}

/** Least squares of the heights over two horizontal directions, with `up` as one more measurement
 * of the slope. */
Plane fit(
    const std::vector<Eigen::Vector3d>& points,
    const std::vector<std::size_t>& chosen,
    const Heights& heights,
    const Eigen::Vector3d& up)
{
  const Eigen::Vector3d e1 = up.unitOrthogonal(), e2 = up.cross(e1);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen) middle += points[i] / static_cast<double>(chosen.size());
  const double share = std::min(1.0, kIndependent / static_cast<double>(chosen.size()));
  Eigen::Matrix3d A = Eigen::Vector3d(0, 1, 1).asDiagonal() * (1 / (kUpSigma * kUpSigma));
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen)
  {
    const Eigen::Vector3d d = points[i] - middle;
    const Eigen::Vector3d row(1, e1.dot(d), e2.dot(d));
    const double weight = share / (heights.sigmas[i] * heights.sigmas[i]);
    A += weight * row * row.transpose();
    b += weight * up.dot(d) * row;
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  return Plane::throughPoint((up - x[1] * e1 - x[2] * e2).normalized(), middle + x[0] * up);
}

}  // namespace

std::optional<PlaneLevel> mainLevel(
    const std::vector<Eigen::Vector3d>& points,
    const Eigen::Vector3d& normal,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options)
{
  constexpr int kRefinements = 2;
  const Heights heights = heightsAlong(points, up, options);
  Plane best;
  std::vector<std::size_t> onBest;
  for (const Eigen::Vector3d& start : {normal, up})
  {
    Plane plane{start, -mode(heightsAlong(points, start, options))};
    auto on = pointsOn(plane, points, heights);
    for (int i = 0; i < kRefinements && on.size() >= kMinPoints; ++i)
    {
      plane = fit(points, on, heights, up);
      on = pointsOn(plane, points, heights);
    }
    if (on.size() <= onBest.size()) continue;
    best = plane;
    onBest = std::move(on);
  }
  if (onBest.size() < kMinPoints) return {};
  PlaneLevel out{best, {}};
  for (const std::size_t i : onBest) out.samples.push_back(points[i]);
  return out;
}

}  // namespace quadmap
