#include "cuboid/HeadingEstimate.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "cuboid/HeadingByLines.h"
#include "quadmap/geometry/HeadingHistogram.h"
#include "quadmap/geometry/LineFit.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
/** The histogram of the normals of vertical surfaces, with what its peak is worth. */
struct NormalPeak
{
  HeadingHistogram::Peak peak;
  double independent = 0;  // normals that do not share their noise, in the whole histogram

  /** Sigmas by which the peak stands above an even spread of as many normals, equation (8.2). */
  double significance() const
  {
    constexpr double kEven = 20.0 / 90.0;  // share of the 20 degrees around any direction
    return (peak.dominance - kEven) * std::sqrt(independent / (kEven * (1.0 - kEven)));
  }
  /** Of the heading without lines, equation (8.5) [rad^2]. */
  double variance() const
  {
    const double agreeing = std::max(1.0, peak.dominance * independent);
    return peak.width * peak.width / agreeing + kHeadingFloor * kHeadingFloor;
  }
};

NormalPeak peakOfNormals(const UprightCloud& cloud)
{
  HeadingHistogram histogram;
  for (const auto& normal : cloud.normals)
  {
    if (!normal) continue;
    const double horizontal = normal->head<2>().norm();
    if (horizontal > kOwnNormal)  // of a vertical surface
      histogram.add(std::atan2(normal->y(), normal->x()), horizontal * horizontal);
  }
  NormalPeak out;
  out.peak = histogram.peak();
  out.independent = out.peak.mass * std::min(1.0, cloud.cellsPerSample / cloud.cellsPerNormal);
  return out;
}

/** The line that the face with a normal near `heading` makes seen along its own slope, equation
 * (8.13). Seen from above, what leans (a screen, the back of a chair) is a strip, whose ends the
 * box may cut askew. */
std::optional<LineFit> faceLine(const UprightCloud& cloud, double heading)
{
  constexpr double kMaxNormalAngle = 20.0 * M_PI / 180.0, kShell = 0.04;  // [m]
  const Eigen::Vector2d n(std::cos(heading), std::sin(heading)), t(-n.y(), n.x());
  std::vector<std::size_t> own;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
  {
    if (!cloud.normals[i]) continue;
    const Eigen::Vector3d& normal = *cloud.normals[i];
    const double ahead = normal.head<2>().dot(n);
    if (ahead <= std::cos(kMaxNormalAngle)) continue;
    own.push_back(i);
    slopes.push_back(normal.z() / ahead);
  }
  if (own.empty()) return {};
  double slope = median(std::move(slopes));
  if (std::abs(slope) < std::tan(kUpright)) slope = 0;
  std::vector<Eigen::Vector2d> points;
  points.reserve(own.size());
  for (const std::size_t i : own)
  {
    const Eigen::Vector3d& p = cloud.points[i];
    points.emplace_back(p.head<2>().dot(t), p.head<2>().dot(n) + slope * p.z());
  }
  return fitLine(std::move(points), kShell);
}

/** Heading and width of the smallest rectangle around the cloud, seen from above. */
struct Rectangle
{
  double yaw = 0, width = 0;  // of its longer side [rad], [m]
};

/** What some points extend over along an axis [m]. */
struct Extent
{
  double most = 0;  // of them, without stray ones
  double all = 0;

  explicit Extent(std::vector<double> values)
  {
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    all = *highest - *lowest;
    most = quantileRange(std::move(values), kStrayShare).width();
  }
  /** The least value that `most` may have when the axis is turned. \param across Extent across it.
   */
  double turnedBy(double angle, const Extent& across) const
  {
    return std::max(0.0, most * std::cos(angle) - across.all * std::sin(angle));
  }
};

Rectangle smallestRectangle(const UprightCloud& cloud)
{
  const std::size_t step = sampleStep(cloud.points.size());
  Rectangle best;
  double bestArea = 1e9;
  for (int degree = 0; degree < 90;)
  {
    const double yaw = degree * M_PI / 180.0, c = std::cos(yaw), s = std::sin(yaw);
    std::vector<double> along, across;
    along.reserve(kSample);
    across.reserve(kSample);
    for (std::size_t i = 0; i < cloud.points.size(); i += step)
    {
      along.push_back(c * cloud.points[i].x() + s * cloud.points[i].y());
      across.push_back(-s * cloud.points[i].x() + c * cloud.points[i].y());
    }
    const Extent x(std::move(along)), y(std::move(across));
    if (x.most * y.most < bestArea)
    {
      bestArea = x.most * y.most;
      best = x.most >= y.most ? Rectangle{yaw, x.most} : Rectangle{yaw + M_PI / 2, y.most};
    }
    // The next heading whose rectangle may be smaller.
    double turn = 0;
    do
    {
      degree += kHeadingStep_deg;
      turn += kHeadingStep_deg * M_PI / 180.0;
    } while (degree < 90 && x.turnedBy(turn, y) * y.turnedBy(turn, x) > bestArea);
  }
  return best;
}

/** Heading of something flat that stands upright: of the line that it makes seen from above. */
std::optional<LineFit> flatHeading(
    const UprightCloud& cloud, const Rectangle& rectangle, const PerceptionOptions& options)
{
  constexpr double kMinShare = 0.75, kMinWidth = 6.0;  // of the points; in shells
  const double shell = 0.02 + 2.0 * options.depthSigma(cloud.medianRange);
  if (rectangle.width < kMinWidth * shell) return {};
  const Eigen::Vector2d t(std::cos(rectangle.yaw), std::sin(rectangle.yaw)), n(-t.y(), t.x());
  std::vector<Eigen::Vector2d> points;
  for (const auto& p : cloud.points) points.emplace_back(p.head<2>().dot(t), p.head<2>().dot(n));
  const auto line = fitLine(std::move(points), shell);
  if (!line || line->share < kMinShare) return {};
  return line;
}

}  // namespace

HeadingEstimate estimateHeading(const UprightCloud& cloud, const PerceptionOptions& options)
{
  constexpr double kMinSignificance = 2.5;
  const NormalPeak normals = peakOfNormals(cloud);
  HeadingEstimate out;
  out.dominance = normals.peak.dominance;
  if (normals.peak.mass >= 2.0 * kFewestOfSurface && out.dominance >= options.yawMinDominance &&
      normals.significance() > kMinSignificance)
  {
    out.defined = true;
    const auto heading =
        headingByLines(normals.peak.yaw, [&](double normal) { return faceLine(cloud, normal); });
    out.yaw = heading ? heading->yaw : normals.peak.yaw;
    out.sigma = std::sqrt(heading ? heading->variance : normals.variance());
    return out;
  }
  const Rectangle rectangle = smallestRectangle(cloud);
  out.yaw = rectangle.yaw;
  if (const auto line = flatHeading(cloud, rectangle, options))
  {
    out.defined = true;
    out.yaw += line->angle;
    out.sigma = std::sqrt(line->variance + kHeadingFloor * kHeadingFloor);
  }
  return out;
}

}  // namespace quadmap
