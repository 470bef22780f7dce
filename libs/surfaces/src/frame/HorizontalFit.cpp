#include "frame/HorizontalFit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
    const SurfaceOptions& options)
{
  constexpr double kFlatness = 0.001;  // of real surfaces [m]
  Heights out;
  out.along.reserve(points.size());
  out.sigmas.reserve(points.size());
  for (const auto& p : points)
  {
    out.along.push_back(direction.dot(p));
    const double perDepth = direction.dot(p) / p.z();  // errors lie along the ray, equation (5.2)
    const double noise = perDepth * options.depthSigma(p.z());
    out.sigmas.push_back(std::sqrt(kFlatness * kFlatness + noise * noise));
  }
  return out;
}

/** The height with which most points agree within two of their sigmas. It is where the fit starts,
 * and a sample of the points is enough for that. */
double mode(const Heights& heights)
{
  constexpr std::size_t kMost = 200;
  const std::size_t step = 1 + heights.along.size() / kMost;
  std::vector<double> lower, upper;  // ends of what each point agrees with
  for (std::size_t i = 0; i < heights.along.size(); i += step)
  {
    lower.push_back(heights.along[i] - 2 * heights.sigmas[i]);
    upper.push_back(heights.along[i] + 2 * heights.sigmas[i]);
  }
  const std::size_t count = lower.size();
  std::sort(lower.begin(), lower.end());
  std::sort(upper.begin(), upper.end());
  std::size_t ended = 0, deepest = 0;
  double from = 0, to = 0;
  for (std::size_t begun = 1; begun <= count; ++begun)
  {
    while (upper[ended] < lower[begun - 1]) ++ended;
    if (begun - ended <= deepest) continue;
    deepest = begun - ended;
    from = lower[begun - 1];
    to = begun < count ? std::min(lower[begun], upper[ended]) : upper[ended];
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
  for (const std::size_t i : chosen) middle += points[i];
  middle /= static_cast<double>(chosen.size());
  const double share = std::min(1.0, kIndependent / static_cast<double>(chosen.size()));
  Eigen::Matrix3d A = Eigen::Vector3d(0, 1, 1).asDiagonal() * (1 / (kUpSigma * kUpSigma));
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen)
  {
    const Eigen::Vector3d d = points[i] - middle;
    const Eigen::Vector3d row(1, e1.dot(d), e2.dot(d));
    const double weight = share / (heights.sigmas[i] * heights.sigmas[i]);
    A.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    b += weight * up.dot(d) * row;
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  return Plane::throughPoint((up - x[1] * e1 - x[2] * e2).normalized(), middle + x[0] * up);
}

}  // namespace

std::optional<HorizontalFit> fitMainHeight(
    const std::vector<Eigen::Vector3d>& points,
    const Eigen::Vector3d& normal,
    const Eigen::Vector3d& up,
    const SurfaceOptions& options)
{
  constexpr int kRefinements = 4;
  if (points.empty()) return {};
  const Heights heights = heightsAlong(points, up, options);
  Plane best;
  std::vector<std::size_t> onBest, all(points.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Plane> starts = {
      {up, -mode(heights)},
      fit(points, all, heights, up)
  };
  if (normal != up)
    starts.insert(starts.begin(), {normal, -mode(heightsAlong(points, normal, options))});
  for (Plane plane : starts)
  {
    auto on = pointsOn(plane, points, heights);
    for (int i = 0; i < kRefinements && on.size() >= kMinPoints; ++i)
    {
      plane = fit(points, on, heights, up);
      auto refined = pointsOn(plane, points, heights);
      if (refined == on) break;
      on = std::move(refined);
    }
    if (on.size() <= onBest.size()) continue;
    best = plane;
    onBest = std::move(on);
  }
  if (onBest.size() < kMinPoints) return {};
  HorizontalFit out{best, {}};
  for (const std::size_t i : onBest) out.samples.push_back(points[i]);
  return out;
}

}  // namespace quadmap
