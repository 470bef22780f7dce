#include "quadmap/surfaces/ScenePlanes.h"

#include <algorithm>
#include <cmath>

#include "frame/FrameFloors.h"
#include "frame/HorizontalFit.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
void setMainHeight(ScenePlane& plane, const HorizontalFit& fit, const SurfaceOptions& options)
{
  plane.plane = fit.plane;
  plane.samples = fit.samples;
  plane.centroid.setZero();
  for (const auto& p : plane.samples) plane.centroid += p;
  plane.centroid /= static_cast<double>(plane.samples.size());
  plane.rim.erase(
      std::remove_if(
          plane.rim.begin(), plane.rim.end(),
          [&](const auto& p) { return !isOnPlane(p, fit.plane, options); }),
      plane.rim.end());
  if (plane.rim.empty()) plane.rim = plane.samples;
}

/** Gives all pieces of the floor one common plane. The floor shows in pieces between the furniture,
 * and each piece alone is too small to tell the slope that they all have. */
void alignFloorPieces(ScenePlanes& planes, const SurfaceOptions& options)
{
  constexpr double kMaxSlope = 0.015;  // [rad]
  const ScenePlane& floor = planes.plane(*planes.floor);
  std::vector<int> pieces;
  std::vector<Eigen::Vector3d> points;
  for (const int i : planes.horizontal)
  {
    const ScenePlane& piece = planes.plane(i);
    const Eigen::Vector3d apart = piece.centroid - floor.centroid;
    if (std::abs(planes.up.dot(apart)) > kSameHeight + kMaxSlope * apart.norm()) continue;
    pieces.push_back(i);
    points.insert(points.end(), piece.samples.begin(), piece.samples.end());
  }
  const auto fit = fitMainHeight(points, floor.plane.n, planes.up, options);
  if (!fit) return;
  for (const int i : pieces) planes.all.planes[static_cast<std::size_t>(i)].plane = fit->plane;
}

/** Returns the samples of a known surface that may still be there. A sample is gone when the frame
 * sees something behind it; such samples are added to `seenThrough`. */
std::vector<Eigen::Vector3d> standing(
    const DepthCloud& cloud, const SurfacePatch& patch, std::vector<Eigen::Vector3f>& seenThrough)
{
  constexpr double kBehind = 0.08;  // [m]; what is seen must lie this far behind the surface
  std::vector<Eigen::Vector3d> out;
  out.reserve(patch.samples.size());
  for (const auto& sample : patch.samples)
  {
    const Eigen::Vector3d p = sample.cast<double>();
    if (p.z() > 0.1)
    {
      const Eigen::Vector2d pixel = cloud.camera().project(p) / cloud.stride();
      const int c = static_cast<int>(std::lround(pixel.x()));
      const int r = static_cast<int>(std::lround(pixel.y()));
      if (cloud.inside(c, r) && cloud.valid(c, r) &&
          patch.plane.signedDistance(cloud.point(c, r).cast<double>()) < -kBehind)
      {
        seenThrough.push_back(sample);
        continue;
      }
    }
    out.push_back(p);
  }
  return out;
}

/** A surface known from other frames, placed in this frame. */
struct KnownSurface
{
  Plane plane;
  std::vector<Eigen::Vector3d> samples;
  double tolerance;                        // planes of this frame so near are the same surface [m]
  bool isFurniture = false;                // by what other frames saw
  bool isShown = false;                    // the frame shows the surface, and `plane` is from it
  std::optional<PlaneExtent> extent = {};  // of the samples, when it was computed already
  double area = 0;                         // of a horizontal surface [m^2]
};

/** Finds the height of a known horizontal surface in this frame. A frame that shows the surface
 * tells its plane better than any pose does. Things on the surface have tops, too, so the height is
 * the one that most points agree on. Where only such tops are in sight, the samples of the surface
 * itself outvote them. */
KnownSurface knownSurfaceIn(
    const DepthCloud& cloud,
    const SurfacePatch& patch,
    std::vector<Eigen::Vector3d> samples,
    const Eigen::Vector3d& up,
    const SurfaceOptions& options)
{
  const Plane& known = patch.plane;
  constexpr double kPoseError = 0.05;  // of its height [m]
  KnownSurface out = {known, std::move(samples), kSameHeight, patch.isFurniture};
  out.extent = PlaneExtent(known.n, out.samples);
  out.area = out.extent->area();
  std::vector<Eigen::Vector3d> near;
  for (const auto& p : cloud.sparsePoints())
    if (std::abs(known.signedDistance(p)) < kPoseError && out.extent->isWithin(p, 0))
      near.push_back(p);
  if (near.empty()) return out;  // most known surfaces are out of sight
  auto votes = near;
  votes.insert(votes.end(), out.samples.begin(), out.samples.end());
  const auto voted = fitMainHeight(votes, known.n, up, options);
  if (!voted) return out;
  near.erase(
      std::remove_if(
          near.begin(), near.end(),
          [&](const auto& p) { return !isOnPlane(p, voted->plane, options); }),
      near.end());
  const auto fit = fitMainHeight(near, known.n, up, options);
  if (!fit) return out;
  out.plane = fit->plane;
  out.isShown = true;
  out.extent.reset();
  return out;
}

/** Adds a surface known from other frames. The planes of this frame that show it are extended by
 * it. When no plane shows it, it becomes a plane of its own. \param candidates Planes of this frame
 * with that orientation. */
void addKnown(ScenePlanes& planes, std::vector<int>& candidates, KnownSurface surface)
{
  constexpr double kNear = 0.10;  // [m]; the poses' noise
  const auto& samples = surface.samples;
  const bool isFloor =
      !surface.isFurniture && isFloorThatEnds(planes, samples.front(), surface.area);
  bool isSeen = false;
  for (const int i : candidates)
  {
    ScenePlane& seen = planes.all.planes[static_cast<std::size_t>(i)];
    double distance = 0;
    for (const auto& p : samples)
      distance += seen.plane.signedDistance(p) / static_cast<double>(samples.size());
    if (std::abs(distance) > surface.tolerance ||
        std::none_of(
            samples.begin(), samples.end(),
            [&](const auto& p) { return seen.extent.isWithin(p, kNear); }))
      continue;
    isSeen = true;
    seen.isFloor |= isFloor && !seen.isFurniture;
    if (seen.extent.isEverywhere()) continue;
    if (surface.isShown) seen.plane = surface.plane;
    seen.rim.insert(seen.rim.end(), samples.begin(), samples.end());
    seen.extent = PlaneExtent(seen.plane.n, seen.rim);
  }
  if (isSeen) return;
  ScenePlane known;
  known.isFloor = isFloor;
  known.plane = surface.plane;
  for (const auto& p : samples) known.centroid += p / static_cast<double>(samples.size());
  known.extent = surface.extent ? *surface.extent : PlaneExtent(known.plane.n, samples);
  known.rim = std::move(surface.samples);
  candidates.push_back(static_cast<int>(planes.all.planes.size()));
  planes.all.planes.push_back(std::move(known));
}

}  // namespace

std::optional<Eigen::Vector3d> upFromPlanes(
    const DepthCloud& cloud, const std::vector<ScenePlane>& planes)
{
  // Hardly anything is below the floor of a scene. Nothing is behind its walls either. Among such
  // planes the largest wins, and those that are off the optical axis count for more, as floors are.
  constexpr double kMargin = 0.08;  // [m]
  constexpr double kMaxBelow = 0.03;
  const ScenePlane* best = nullptr;
  double bestScore = 0;
  for (const auto& plane : planes)
  {
    if (shareBelow(cloud, plane.plane, kMargin) > kMaxBelow) continue;
    const Eigen::Vector2d direction = plane.centroid.head<2>() / plane.centroid.z();
    const double score = plane.share * (1.0 + direction.norm());  // floors lie off the optical axis
    if (score > bestScore)
    {
      bestScore = score;
      best = &plane;
    }
  }
  if (!best) return {};
  return best->plane.n;
}

ScenePlanes classifyPlanes(
    const DepthCloud& cloud,
    PlaneSegmentation segmentation,
    const Eigen::Vector3d& up,
    const std::vector<SurfacePatch>& known,
    const SurfaceOptions& options)
{
  constexpr double kFloorMargin = 0.06;   // [m]
  constexpr std::size_t kMinSamples = 3;  // that make a surface
  constexpr double kSameWall = 0.05;      // [m]; the poses' noise
  ScenePlanes out;
  out.all = std::move(segmentation);
  out.up = up.normalized();
  for (int i = 0; i < static_cast<int>(out.all.planes.size()); ++i)
  {
    ScenePlane& plane = out.all.planes[static_cast<std::size_t>(i)];
    const double cosine = plane.plane.n.dot(out.up);
    const bool isHorizontal = cosine > std::cos(options.planeMaxTilt);
    if (!isHorizontal && std::abs(cosine) > std::sin(options.planeMaxTilt)) continue;
    (isHorizontal ? out.horizontal : out.vertical).push_back(i);
    if (isHorizontal)
      if (const auto fit = fitMainHeight(plane.samples, plane.plane.n, out.up, options))
        setMainHeight(plane, *fit, options);
    if (!plane.rim.empty()) plane.extent = PlaneExtent(plane.plane.n, plane.rim);
  }
  const auto height = [&](int i) { return out.plane(i).centroid.dot(out.up); };
  const auto sortByHeight = [&]
  {
    std::stable_sort(
        out.horizontal.begin(), out.horizontal.end(),
        [&](int a, int b) { return height(a) < height(b); });
  };
  sortByHeight();
  // Only the lowest can be the floor, and only when nothing shows under it.
  if (!out.horizontal.empty() &&
      shareBelow(cloud, out.plane(out.horizontal.front()).plane, kFloorMargin) <= kMaxBelowFloor)
    out.floor = out.horizontal.front();
  out.floorSeen = out.floor.has_value();
  if (out.floorSeen) alignFloorPieces(out, options);
  markHollow(out, cloud, options);
  for (const auto& patch : known)
    if (patch.kind == SurfaceKind::Floor) useKnownFloor(out, cloud, patch.plane);
  if (out.floor) out.all.planes[static_cast<std::size_t>(*out.floor)].extent = PlaneExtent();
  for (const auto& patch : known)
  {
    auto samples = standing(cloud, patch, out.seenThrough);
    if (patch.kind == SurfaceKind::Floor || samples.size() < kMinSamples) continue;
    if (patch.kind == SurfaceKind::Wall)
      addKnown(out, out.vertical, {patch.plane, std::move(samples), kSameWall});
    else
      addKnown(
          out, out.horizontal, knownSurfaceIn(cloud, patch, std::move(samples), out.up, options));
  }
  sortByHeight();
  return out;
}

FrameSurfaces surfacesOf(const DepthCloud& cloud, const ScenePlanes& planes)
{
  constexpr double kWallMargin = 0.10;  // [m]
  constexpr double kMaxBehindWall = 0.03;
  constexpr double kMinWallShare = 0.02;
  FrameSurfaces out;
  const auto add = [&](int i, SurfaceKind kind)
  {
    const ScenePlane& plane = planes.plane(i);
    SurfacePatch patch = {kind, plane.plane, {}, plane.isFurniture};
    for (const auto& p : plane.samples) patch.samples.push_back(p.cast<float>());
    out.seen.push_back(std::move(patch));
  };
  for (const int i : planes.horizontal)
    if (planes.plane(i).share > 0)
      add(i, planes.floorSeen && i == *planes.floor ? SurfaceKind::Floor : SurfaceKind::Horizontal);
  for (const int i : planes.vertical)
    if (planes.plane(i).share > kMinWallShare &&
        shareBelow(cloud, planes.plane(i).plane, kWallMargin) <= kMaxBehindWall)
      add(i, SurfaceKind::Wall);
  out.seenThrough = planes.seenThrough;
  out.contradictsFloor = planes.contradictsFloor;
  return out;
}

}  // namespace quadmap
