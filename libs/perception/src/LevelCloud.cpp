#include "LevelCloud.h"

#include <algorithm>
#include <cmath>

#include "YawHistogram.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kPi = 3.14159265358979323846;

Eigen::Matrix3d levelRotation(const Eigen::Vector3d& up, const Eigen::Vector3d& towards)
{
  Eigen::Vector3d x = towards - up * up.dot(towards);
  if (x.norm() < 1e-3) x = up.unitOrthogonal();  // seen from exactly above
  x.normalize();
  Eigen::Matrix3d R;
  R.row(0) = x;
  R.row(1) = up.cross(x);
  R.row(2) = up;
  return R;
}

/** Yaw correction from the line fitted to the points of one vertical face. */
struct LineFit
{
  double angle = 0, information = 0;  // [rad], [1/rad^2]
};

LineFit fitFaceLine(const LevelCloud& cloud, double heading, const PerceptionOptions& options)
{
  constexpr double kMaxNormalAngle = 20.0 * kPi / 180.0, kShell = 0.04;  // [m]
  const Eigen::Vector2d n(std::cos(heading), std::sin(heading)), t(-n.y(), n.x());
  std::vector<double> across, along;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
  {
    if (!cloud.normals[i] || cloud.normals[i]->head<2>().dot(n) < std::cos(kMaxNormalAngle))
      continue;
    across.push_back(cloud.points[i].head<2>().dot(n));
    along.push_back(cloud.points[i].head<2>().dot(t));
  }
  constexpr std::size_t kMinPoints = 40;
  if (across.size() < kMinPoints) return {};
  double slope = 0, offset = median(across), variance = 0, mean = 0;
  for (int iteration = 0; iteration < 3; ++iteration)
  {
    double sw = 0, st = 0, sa = 0, stt = 0, sta = 0;
    for (std::size_t i = 0; i < across.size(); ++i)
    {
      if (std::abs(across[i] - offset - slope * along[i]) > kShell) continue;
      sw += 1;
      st += along[i];
      sa += across[i];
      stt += along[i] * along[i];
      sta += along[i] * across[i];
    }
    if (sw < kMinPoints) return {};
    mean = st / sw;
    variance = stt - st * mean;
    if (variance < 1e-6) return {};
    slope = (sta - st * sa / sw) / variance;
    offset = sa / sw - slope * mean;
  }
  // Depth noise is correlated over several pixels: a tenth of the points is independent.
  const double sigma = options.depthSigma(cloud.medianRange) + 0.002;
  return {std::atan(-slope), 0.1 * variance / (sigma * sigma)};
}

double smallestRectangleYaw(const LevelCloud& cloud)
{
  const std::size_t step = std::max<std::size_t>(1, cloud.points.size() / 400);
  double best = 0, bestArea = 1e9;
  for (int degree = 0; degree < 90; degree += 2)
  {
    const double yaw = degree * kPi / 180.0, c = std::cos(yaw), s = std::sin(yaw);
    std::vector<double> x, y;
    for (std::size_t i = 0; i < cloud.points.size(); i += step)
    {
      x.push_back(c * cloud.points[i].x() + s * cloud.points[i].y());
      y.push_back(-s * cloud.points[i].x() + c * cloud.points[i].y());
    }
    const double area =
        (quantile(x, 0.98) - quantile(x, 0.02)) * (quantile(y, 0.98) - quantile(y, 0.02));
    if (area < bestArea)
    {
      bestArea = area;
      best = yaw;
    }
  }
  return best;
}

}  // namespace

LevelCloud levelCloud(
    const DepthCloud& cloud, const ObjectCloud& object, const Eigen::Vector3d& up_optical)
{
  LevelCloud out;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  std::vector<double> ranges;
  for (const auto& p : object.points)
  {
    centroid += p;
    ranges.push_back(p.z());
  }
  out.R_level_optical = levelRotation(up_optical, centroid.normalized());
  out.medianRange = median(ranges);
  constexpr std::size_t kMaxSamples = 5000;
  const std::size_t step = 1 + object.points.size() / kMaxSamples;
  for (std::size_t i = 0; i < object.points.size(); i += step)
  {
    out.cells.push_back(object.cells[i]);
    out.points.push_back(out.R_level_optical * object.points[i]);
    const auto normal = cloud.normal(object.cells[i].c, object.cells[i].r);
    if (normal)
      out.normals.emplace_back(out.R_level_optical * normal->cast<double>());
    else
      out.normals.emplace_back();
  }
  return out;
}

YawEstimate estimateYaw(const LevelCloud& cloud, const PerceptionOptions& options)
{
  constexpr double kMinHorizontality = 0.8, kMinMass = 40.0;
  YawHistogram histogram;
  for (const auto& normal : cloud.normals)
  {
    if (!normal) continue;
    const double horizontal = normal->head<2>().norm();
    if (horizontal > kMinHorizontality)
      histogram.add(std::atan2(normal->y(), normal->x()), horizontal * horizontal);
  }
  const auto peak = histogram.peak();
  YawEstimate out;
  out.dominance = peak.dominance;
  if (peak.mass < kMinMass || peak.dominance < options.yawMinDominance)
  {
    out.yaw = smallestRectangleYaw(cloud);
    return out;
  }
  double information = 0, correction = 0;
  for (int side = 0; side < 4; ++side)
  {
    const LineFit line = fitFaceLine(cloud, peak.yaw + side * kPi / 2, options);
    information += line.information;
    correction += line.information * line.angle;
  }
  constexpr double kMaxCorrection = 10.0 * kPi / 180.0, kCoarseSigma = 4.0 * kPi / 180.0;
  constexpr double kSigmaFloor = 0.8 * kPi / 180.0;  // faces are not perfectly flat or parallel
  if (information > 0) correction /= information;
  const bool refined = information > 0 && std::abs(correction) < kMaxCorrection;
  out.defined = true;
  out.yaw = peak.yaw + (refined ? correction : 0.0);
  out.sigma = refined ? std::hypot(kSigmaFloor, 1.0 / std::sqrt(information)) : kCoarseSigma;
  return out;
}

}  // namespace quadmap
