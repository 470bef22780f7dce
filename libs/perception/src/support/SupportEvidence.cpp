#include "support/SupportEvidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cloud/Precision.h"
#include "quadmap/geometry/DensestWindow.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
constexpr int kMaxFeet = 40;   // most points of an object that are compared with a plane's extent
constexpr int kMaxLines = 12;  // from the lowest points down, along which the gap is probed

/** Keeps the points of the depth range of a given width that has most of them. */
std::vector<Eigen::Vector3d> atMainDepth(std::vector<Eigen::Vector3d> all, double width)
{
  std::stable_sort(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  std::vector<double> depths;
  for (const auto& p : all) depths.push_back(p.z());
  const Window window = densestWindow(depths, width);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(window.first);
  return {first, first + static_cast<std::ptrdiff_t>(window.count)};
}

/** Puts points in order along a direction. */
void sortAlong(const Eigen::Vector3d& direction, std::vector<Eigen::Vector3d>& points)
{
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(direction.dot(points[i]), i);
  std::sort(order.begin(), order.end());
  const auto before = points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = before[order[i].second];
}

/** Does a point appear in a box? Beyond the image's border the box may go on. */
bool appearsIn(const PinholeCamera& camera, const ImageBox& box, const Eigen::Vector3d& p)
{
  if (p.z() < 0.1) return false;
  const Eigen::Vector2d pixel =
      camera.project(p).cwiseMax(0.0).cwiseMin(Eigen::Vector2d(camera.width, camera.height));
  const Eigen::Vector2d error = kBoxErrorShare * Eigen::Vector2d(box.width(), box.height());
  return pixel.x() > box.x1 - error.x() && pixel.x() < box.x2 + error.x() &&
         pixel.y() > box.y1 - error.y() && pixel.y() < box.y2 + error.y();
}

/** What the camera sees in the direction of a point [m]; nothing where no depth was measured. */
std::optional<Eigen::Vector3d> seenTowards(const DepthCloud& cloud, const Eigen::Vector3d& p)
{
  if (p.z() < 0.1) return {};
  const Eigen::Vector2d cell = cloud.camera().project(p) / cloud.stride();
  const int c = static_cast<int>(std::lround(cell.x()));
  const int r = static_cast<int>(std::lround(cell.y()));
  if (!cloud.inside(c, r) || !cloud.valid(c, r)) return {};
  return cloud.point(c, r).cast<double>();
}

/** Would an object at a point show outside its box, with nothing nearer in front? A detector would
 * have drawn the box around it: the object is not there. */
bool isAbsent(const DepthCloud& cloud, const ImageBox& box, const Eigen::Vector3d& p, double margin)
{
  if (appearsIn(cloud.camera(), box, p)) return false;
  const auto seen = seenTowards(cloud, p);
  return seen && seen->z() > p.z() - margin;
}

/** Does the camera look down past a surface somewhere between a point and its extent? A keyboard is
 * too thin to tell along the ray, but what shows beside it lies clearly below its top. */
bool looksPastRim(
    const DepthCloud& cloud,
    const SupportSurface& surface,
    const Eigen::Vector3d& point,
    const PerceptionOptions& options)
{
  const Plane& plane = surface.plane;
  const Eigen::Vector3d foot = point - plane.signedDistance(point) * plane.n;
  const auto looksPast = [&](const Eigen::Vector3d& p)
  {
    const auto seen = seenTowards(cloud, p);
    return seen && plane.signedDistance(*seen) < -options.onPlane(seen->z());
  };
  const Eigen::Vector3d toExtent = surface.extent.toExtent(point);
  constexpr std::array kShares = {0.0, 0.3, 0.6, 0.9};
  return std::any_of(
      kShares.begin(), kShares.end(),
      [&](double share) { return looksPast(foot + share * toExtent); });
}

/** How surely a surface reaches under a point, in [0, 1]: "covered" of equation (6.1). It is 1
 * inside the extent of the surface. Outside it falls to 0 within 8 cm when the rim is seen, which
 * is known to some centimetres. It falls more slowly where the surface may go on out of sight,
 * behind or under the object. The top of a thing ends within the thing's box. */
double coverage(
    const DepthCloud& cloud,
    const SupportSurface& surface,
    const Eigen::Vector3d& p,
    const PerceptionOptions& options)
{
  constexpr double kSeenFall = 0.08, kHiddenFall = 0.4;  // [m]
  const Plane& plane = surface.plane;
  if (surface.box &&
      !appearsIn(cloud.camera(), *surface.box, p - plane.signedDistance(p) * plane.n))
    return 0.0;
  if (surface.extent.isWithin(p, 0.0)) return 1.0;
  if (!surface.extent.isWithin(p, kHiddenFall)) return 0.0;
  const bool isRim = looksPastRim(cloud, surface, p, options);
  return std::max(0.0, 1.0 - surface.extent.outside(p) / (isRim ? kSeenFall : kHiddenFall));
}

/** "absent" of equation (6.1). \param points Of the object, the lowest first. */
double absentShare(
    const DepthCloud& cloud,
    const Plane& plane,
    const std::vector<Eigen::Vector3d>& points,
    const ImageBox& box,
    bool gapIsHigh,
    const PerceptionOptions& options)
{
  const std::size_t lowest = std::max<std::size_t>(1, points.size() / 5);
  const std::size_t step = 1 + lowest / kMaxLines;
  const double end = plane.signedDistance(points.front());
  const std::vector<double> shares =
      gapIsHigh ? std::vector<double>{0.1, 0.2, 0.3, 0.5, 0.7} : std::vector<double>{0.3, 0.5, 0.7};
  double absent = 0;
  int lines = 0;
  for (std::size_t i = 0; i < lowest; i += step, ++lines)
  {
    const double margin = 0.10 + kBeyondChance * options.depthSigma(points[i].z());
    const double height = plane.signedDistance(points[i]);
    const auto isFree = [&](double share)
    {
      // Just below the end, what hides the rest is hardly nearer.
      if (gapIsHigh && (1 - share) * height > end - margin) return false;
      return isAbsent(cloud, box, points[i] - share * height * plane.n, margin);
    };
    const auto free = std::count_if(shares.begin(), shares.end(), isFree);
    // What has ended does not go on behind what hides the rest of the line.
    if (gapIsHigh)
      absent += free > 0 ? 1 : 0;
    else
      absent += static_cast<double>(free) / static_cast<double>(shares.size());
  }
  return absent / lines;
}

}  // namespace

RoughObject roughObject(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const DetectedObject& detection,
    const LabelProperties& label,
    const PerceptionOptions& options)
{
  const ImageBox box = detection.box.clipped(cloud.camera().width, cloud.camera().height);
  const auto range = cloud.cellsOf(box);
  RoughObject out;
  out.planeShares = planes.all.sharesWithin(range);
  const int step = stepFor(range.cells(), kSample);
  std::vector<Eigen::Vector3d> all;
  for (int r = range.r0; r < range.r1; r += step)
    for (int c = range.c0; c < range.c1; c += step)
    {
      if (!cloud.valid(c, r)) continue;
      const double u = c * cloud.stride(), v = r * cloud.stride();
      if (detection.mask &&
          !detection.mask->contains(static_cast<unsigned>(u), static_cast<unsigned>(v)))
        continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      const double tolerance = options.onPlane(p.z());
      const int plane = planes.all.planeAt(cloud, c, r, tolerance);
      if (plane >= 0 && !out.owns(plane)) continue;
      all.push_back(p);
    }
  const double width = label.typicalSize.head<2>().norm();
  out.points = atMainDepth(std::move(all), width);
  sortAlong(planes.up, out.points);
  if (out.points.size() < kFewestCells) out.points.clear();
  return out;
}

StandingEvidence standingEvidence(
    const DepthCloud& cloud,
    const SupportSurface& surface,
    const RoughObject& object,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  const Plane& plane = surface.plane;
  const auto& points = object.points;
  const double n = static_cast<double>(points.size());
  StandingEvidence out;
  std::vector<double> heights;
  for (const auto& p : points)
  {
    const double height = plane.signedDistance(p);
    out.below += height < -contactTolerance(p.z(), options) ? 1 / n : 0;
    heights.push_back(height);
  }
  out.top = *std::max_element(heights.begin(), heights.end());
  out.gap = std::max(0.0, quantile(std::move(heights), 0.1));

  const std::size_t step = 1 + points.size() / kMaxFeet;
  int looked = 0;
  for (std::size_t i = 0; i < points.size(); i += step, ++looked)
    out.covered += coverage(cloud, surface, points[i], options);
  out.covered /= looked;

  if (out.gap == 0) return out;  // nothing is in between
  out.absent = absentShare(cloud, plane, points, box, out.isHigh(), options);
  return out;
}

std::optional<ScenePlane> topOf(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const RoughObject& object,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  constexpr double kThickness = 0.02;  // of the layer of points that is one surface [m]
  constexpr int kFinest = 4;           // times more cells than elsewhere: tops are small
  const auto range = cloud.cellsOf(box);
  const int step = stepFor(range.cells(), kFinest * kSample);
  std::vector<Eigen::Vector3d> points;
  for (int r = range.r0; r < range.r1; r += step)
    for (int c = range.c0; c < range.c1; c += step)
    {
      if (!cloud.valid(c, r)) continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      const int plane = planes.all.planeAt(cloud, c, r, options.onPlane(p.z()));
      if (plane >= 0 && !object.owns(plane)) continue;
      const auto normal = cloud.normal(c, r);
      if (normal && normal->cast<double>().dot(planes.up) >= kOwnNormal) points.push_back(p);
    }
  sortAlong(planes.up, points);
  std::vector<double> heights;
  for (const auto& p : points) heights.push_back(planes.up.dot(p));
  const Window layer = densestWindow(heights, kThickness);
  if (layer.count < kFewestOfSurface) return {};
  ScenePlane out;
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(layer.first);
  out.rim.assign(first, first + static_cast<std::ptrdiff_t>(layer.count));
  out.centroid = points[layer.middle()];
  out.plane = Plane::throughPoint(planes.up, out.centroid);
  out.extent = PlaneExtent(planes.up, out.rim);
  return out;
}

}  // namespace quadmap
