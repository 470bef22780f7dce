#include "cloud/WallsBehind.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloud/BoxSurroundings.h"
#include "cloud/Precision.h"
#include "support/SupportRing.h"

namespace quadmap
{
namespace
{
/** A point and how near to a plane it is on it [m]. */
struct TolerantPoint
{
  Eigen::Vector3d point;
  double tolerance;
  bool isOn(const Plane& plane) const { return std::abs(plane.signedDistance(point)) < tolerance; }
};
using TolerantPoints = std::vector<TolerantPoint>;

TolerantPoints withTolerances(
    const std::vector<Eigen::Vector3d>& points, const PerceptionOptions& options)
{
  TolerantPoints out;
  out.reserve(points.size());
  for (const auto& p : points) out.push_back({p, options.onPlane(p.z())});
  return out;
}

/** Points around a box, a regular sample, without floors and table tops. */
TolerantPoints surroundings(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  const auto isOnTop = [&](const TolerantPoint& p)
  {
    return std::any_of(
        planes.horizontal.begin(), planes.horizontal.end(),
        [&](int i) { return p.isOn(planes.plane(i).plane); });
  };
  const auto outer = cloud.cellsOf(withSurroundings(box));
  const auto inner = cloud.cellsOf(box);
  TolerantPoints out;
  for (int r = outer.r0; r < outer.r1; r += kMixedCells)
    for (int c = outer.c0; c < outer.c1; c += kMixedCells)
    {
      if (inner.contains(c, r) || !cloud.valid(c, r)) continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      const TolerantPoint tolerant = {p, options.onPlane(p.z())};
      if (!isOnTop(tolerant)) out.push_back(tolerant);
    }
  return out;
}

int countOn(const Plane& plane, const TolerantPoints& points)
{
  int count = 0;
  for (const auto& p : points) count += p.isOn(plane) ? 1 : 0;
  return count;
}

/** Share of the surroundings on a plane that makes it the wall behind the box; less may be a thing
 * beside the object. */
constexpr double kMinWallShare = 0.15;

/** Vertical planes that much of the box's surroundings lies on: they go on behind the object, also
 * where the segmentation lost them. */
std::vector<Plane> wallsAround(
    const ScenePlanes& planes, const TolerantPoints& around, const CandidateRule& rule)
{
  std::vector<Plane> out;
  for (const int i : planes.vertical)
    if (rule.reachesBeyond(i) &&
        countOn(planes.plane(i).plane, around) > kMinWallShare * static_cast<double>(around.size()))
      out.push_back(planes.plane(i).plane);
  return out;
}

/** The vertical plane through what lies on one that is nearly it, by least squares, with the sigma
 * of its direction, (8.14). */
FittedWall refined(const Plane& wall, const TolerantPoints& around, const Eigen::Vector3d& up)
{
  // Points next to each other err alike, and those far off are left out: three times what
  // independent ones would make it is what walls of random rooms are off by.
  constexpr double kAlike = 3;
  const Eigen::Vector3d along = up.cross(wall.n);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0, alongSquares = 0, products = 0;
  for (const auto& p : around)
    if (p.isOn(wall))
    {
      sum += p.point;
      ++count;
    }
  const Eigen::Vector3d mean = sum / count;
  for (const auto& p : around)
    if (p.isOn(wall))
    {
      const Eigen::Vector3d off = p.point - mean;
      alongSquares += along.dot(off) * along.dot(off);
      products += along.dot(off) * wall.n.dot(off);
    }
  FittedWall out;
  out.plane.n = (alongSquares * wall.n - products * along).normalized();
  out.plane.d = -out.plane.n.dot(mean);
  double squares = 0;
  for (const auto& p : around)
    if (p.isOn(wall)) squares += std::pow(out.plane.signedDistance(p.point), 2);
  out.headingSigma = kAlike * std::sqrt(squares / count / alongSquares);
  return out;
}

/** The vertical plane that most of the surroundings lies on, where the segmentation found none:
 * the best through pairs of points in a fixed order. */
std::optional<FittedWall> wallThrough(const TolerantPoints& around, const Eigen::Vector3d& up)
{
  constexpr std::size_t kTrials = 60;
  constexpr double kMinBase = 0.2;  // between the two points [m]
  const std::size_t n = around.size();
  if (n < kTrials) return {};
  std::optional<Plane> best;
  int bestCount = static_cast<int>(kMinWallShare * static_cast<double>(n));
  for (std::size_t i = 0; i < kTrials; ++i)
  {
    // Strides that are coprime with most sizes spread the pairs over the ring.
    const Eigen::Vector3d& p = around[(i * 7919) % n].point;
    const Eigen::Vector3d& q = around[(i * 104729 + n / 2) % n].point;
    const Eigen::Vector3d along = q - p;
    if ((along - up * up.dot(along)).norm() < kMinBase) continue;
    Plane plane;
    plane.n = up.cross(along).normalized();
    plane.d = -plane.n.dot(p);
    if (plane.d < 0) plane = {-plane.n, -plane.d};  // towards the camera
    const int count = countOn(plane, around);
    if (count <= bestCount) continue;
    bestCount = count;
    best = plane;
  }
  if (!best) return {};
  return refined(*best, around, up);
}

/** Tells beyond which of the two horizontal ends of a box the image goes on. */
struct SeenEnds
{
  bool left, right;

  SeenEnds(const PinholeCamera& camera, const Eigen::Vector3d& up, const ImageBox& box)
  {
    const Eigen::Vector2d down = downInImage(camera, up, box);
    const bool isUpright = std::abs(down.y()) >= std::abs(down.x());
    const double margin = 0.5 * surroundingWidth(box);
    const bool before = (isUpright ? box.x1 : box.y1) - margin > 0;
    const bool after = isUpright ? box.x2 + margin < camera.width : box.y2 + margin < camera.height;
    const bool isMirrored = isUpright ? down.y() < 0 : down.x() > 0;
    left = isMirrored ? after : before;
    right = isMirrored ? before : after;
  }
};

/** Is a plane the wall behind the box? What of the candidates lies on it is enclosed by what of the
 * surroundings does, as far as the image goes; the side of a thing that stands beside the object
 * ends before it. */
bool goesOnBehind(
    const Plane& wall,
    const Eigen::Vector3d& up,
    const SeenEnds& seen,
    const TolerantPoints& around,
    const TolerantPoints& points)
{
  const Eigen::Vector3d along = up.cross(wall.n);  // to the right, as walls face the camera
  const auto rangeOf = [&](const TolerantPoints& cloud)
  {
    Eigen::AlignedBox1d range;
    for (const auto& p : cloud)
      if (p.isOn(wall)) range.extend(Eigen::Matrix<double, 1, 1>(along.dot(p.point)));
    return range;
  };
  const auto on = rangeOf(points), enclosing = rangeOf(around);
  if (on.isEmpty() || enclosing.isEmpty()) return false;
  return (!seen.left || on.min()[0] > enclosing.min()[0] - kEndSlack) &&
         (!seen.right || on.max()[0] < enclosing.max()[0] + kEndSlack);
}

/** Could it be the object's own side, with something of the object behind it? */
bool isOwnSide(const Plane& wall, const TolerantPoints& points)
{
  const auto behind = std::count_if(
      points.begin(), points.end(),
      [&](const auto& p) { return wall.signedDistance(p.point) < -p.tolerance; });
  return static_cast<double>(behind) > kStrayShare * static_cast<double>(points.size());
}

}  // namespace

void dropWallsBehind(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options,
    BoxCandidates& candidates)
{
  TolerantPoints around = surroundings(cloud, planes, box, options);
  const SeenEnds seen(cloud.camera(), planes.up, box);
  const auto walls = wallsAround(planes, around, candidates.rule);
  const auto drop = [&](const Plane& wall)
  {
    candidates.rule.addWall(wall);
    keepOnly(
        candidates,
        [&](std::size_t i)
        {
          const auto& p = candidates.points[i];
          return !TolerantPoint{p, options.onPlane(p.z())}.isOn(wall);
        });
  };
  for (const auto& wall : walls)
    if (goesOnBehind(wall, planes.up, seen, around, withTolerances(candidates.points, options)))
      drop(wall);
  // A corner of the room has two walls.
  const auto isOnKnown = [&](const TolerantPoint& p) {
    return std::any_of(walls.begin(), walls.end(), [&](const auto& wall) { return p.isOn(wall); });
  };
  around.erase(std::remove_if(around.begin(), around.end(), isOnKnown), around.end());
  const auto wall = wallThrough(around, planes.up);
  if (!wall) return;
  const auto points = withTolerances(candidates.points, options);
  if (!isOwnSide(wall->plane, points) && goesOnBehind(wall->plane, planes.up, seen, around, points))
    drop(wall->plane);
}

std::optional<FittedWall> wallAround(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  return wallThrough(surroundings(cloud, planes, box, options), planes.up);
}

}  // namespace quadmap
