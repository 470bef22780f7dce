#include "Geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/geometry/ConvexHull.h"
#include "quadmap/geometry/CuboidExtent.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kShareOn = 0.5;  // of the subject's footprint above the object
constexpr double kLeastTolerance = 0.02, kMostTolerance = 0.05;  // of heights [m]
constexpr double kShareIn = 0.5;      // of the subject's volume inside the object
constexpr double kShareBeside = 0.5;  // of the lower one's height that both have in common
constexpr double kSquare = 0.8;       // ratio of the sides above which a footprint has four fronts
constexpr double kFarthestFront = 3;  // [m]
constexpr const char* kChair = "chair";   // what is drawn up to a table, and faces it
constexpr double kLeastDirection = 0.01;  // to what it faces, below which there is no front [m]
constexpr double kDetour = 0.1;           // longer way by what is between, as a share

Eigen::Vector2d flat(const Eigen::Vector3d& v) { return v.head<2>(); }

Footprint footprintOf(const Ellipsoid& object)
{
  const Eigen::Matrix<double, 3, 8> corners = object.cuboidCorners();
  Footprint below;
  for (Eigen::Index i = 0; i < corners.cols(); ++i) below.push_back(flat(corners.col(i)));
  return convexHull(below);
}

/** The median of the centres of all objects that are not doubtful; of all when there are none. */
Eigen::Vector2d middleOf(const Inventory& inventory)
{
  std::vector<double> x, y;
  const bool allDoubtful = std::all_of(
      inventory.items.begin(), inventory.items.end(),
      [](const InventoryItem& item) { return item.isDoubtful(); });
  for (const InventoryItem& item : inventory.items)
  {
    if (item.isDoubtful() && !allDoubtful) continue;
    x.push_back(item.record.object.center().x());
    y.push_back(item.record.object.center().y());
  }
  if (x.empty()) return Eigen::Vector2d::Zero();
  return {median(x), median(y)};
}

/** The nearest point of the line along the middle of an oblong thing, which ends as far from its
 * short sides as from its long ones; of a square thing it is the centre. */
Eigen::Vector2d nearestOfMiddleLine(const Ellipsoid& object, const Eigen::Vector2d& from)
{
  const Eigen::Vector3d s = object.semiAxes();
  const Eigen::Index longer = s.x() >= s.y() ? 0 : 1;
  const Eigen::Vector2d along = flat(object.rotation().col(longer)).normalized();
  const double end = s[longer] - s[1 - longer];
  const double at = along.dot(from - flat(object.center()));
  return flat(object.center()) + std::clamp(at, -end, end) * along;
}

}  // namespace

Geometry::Geometry(const Inventory& inventory) : middle_(middleOf(inventory))
{
  for (const InventoryItem& item : inventory.items)
    solids_.push_back(solidOf(item, inventory.labels));
  for (Solid& solid : solids_)
  {
    solid.table = tableFor(solid);
    const Eigen::Vector2d at = flat(solid.object.center());
    const Eigen::Vector2d faced =
        solid.table ? nearestOfMiddleLine(solids_[*solid.table].object, at) : middle_;
    solid.front = frontTowards(solid, faced);
  }
}

Geometry::Solid Geometry::solidOf(const InventoryItem& item, const LabelTable& labels)
{
  const LabelProperties label = labels.properties(item.record.label);
  Solid solid;
  solid.object = item.record.object;
  solid.footprint = footprintOf(solid.object);
  solid.area = areaOf(solid.footprint);
  const double half = cuboidHalfExtent(solid.object, Eigen::Vector3d::UnitZ());
  solid.bottom = solid.object.center().z() - half;
  solid.top = solid.object.center().z() + half;
  // (23.3): chairs and beds rise above what things stand on.
  const double quarter = 0.25 * (solid.top - solid.bottom);
  solid.seatTolerance = std::clamp(quarter, kLeastTolerance, kMostTolerance);
  const bool hasSeat = label.support == UsualSupport::Floor && !label.levelTop;
  solid.lowestSeat = hasSeat ? solid.bottom + quarter : solid.top - solid.seatTolerance;
  solid.hasLevelTop = label.levelTop;
  solid.isDirected = item.record.orientationDefined;
  solid.isChair = label.name == labels.canonical(kChair);
  solid.isDoubtful = item.isDoubtful();
  return solid;
}

double Geometry::gap(std::size_t i, std::size_t j) const { return gap(solids_[i], solids_[j]); }

double Geometry::gap(const Solid& a, const Solid& b) const
{
  const double up = std::max({0.0, a.bottom - b.top, b.bottom - a.top});
  return std::hypot(distanceBetween(a.footprint, b.footprint), up);  // (23.2)
}

std::optional<double> Geometry::on(std::size_t i, std::size_t j) const
{
  const Solid &a = solids_[i], &b = solids_[j];
  const bool standsThere = a.bottom >= b.lowestSeat && a.bottom <= b.top + b.seatTolerance &&
                           a.object.center().z() > b.object.center().z();
  if (i == j || !standsThere) return std::nullopt;
  if (sharedArea(a.footprint, b.footprint) < kShareOn * a.area) return std::nullopt;  // (23.4)
  return gap(i, j);
}

std::optional<double> Geometry::in(std::size_t i, std::size_t j) const
{
  const Ellipsoid &a = solids_[i].object, &b = solids_[j].object;
  if (i == j || a.cuboidVolume() >= b.cuboidVolume()) return std::nullopt;
  if (cuboidIntersectionVolume(a, b) < kShareIn * a.cuboidVolume()) return std::nullopt;  // (23.5)
  return 0.0;
}

/** Largest gap at which people say "next to", (23.6) [m]. */
double Geometry::nextToBound(const Solid& a, const Solid& b) const
{
  return 0.1 + 0.5 * std::pow(a.area * b.area, 0.25);
}

std::optional<double> Geometry::nextTo(std::size_t i, std::size_t j) const
{
  const Solid &a = solids_[i], &b = solids_[j];
  if (i == j || on(i, j) || on(j, i) || in(i, j) || in(j, i)) return std::nullopt;
  const double common = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
  const double lower = std::min(a.top - a.bottom, b.top - b.bottom);
  if (common < kShareBeside * lower) return std::nullopt;  // (23.7)
  const double between = gap(i, j);
  if (between > nextToBound(a, b)) return std::nullopt;
  return between;
}

std::optional<double> Geometry::near(std::size_t i, std::size_t j) const
{
  if (i == j) return std::nullopt;
  const double between = gap(i, j);
  if (between > 3 * nextToBound(solids_[i], solids_[j])) return std::nullopt;  // (23.8)
  return between;
}

/** The table that a chair is drawn up to; of several the one whose middle line is nearest. */
std::optional<std::size_t> Geometry::tableFor(const Solid& chair) const
{
  std::optional<std::size_t> found;
  if (!chair.isChair) return found;
  const Eigen::Vector3d at = chair.object.center();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size(); ++i)
  {
    const Solid& table = solids_[i];
    const bool isAtSeat = table.bottom < at.z() && table.top > at.z();
    if (!table.hasLevelTop || table.isDoubtful || !isAtSeat) continue;
    if (gap(chair, table) > nextToBound(chair, table)) continue;
    const double away = (nearestOfMiddleLine(table.object, flat(at)) - flat(at)).norm();
    if (away >= nearest) continue;
    nearest = away;
    found = i;
  }
  return found;
}

/** The direction out of the front of an object that faces a point, (23.9); zero when nothing tells.
 */
Eigen::Vector2d Geometry::frontTowards(const Solid& solid, const Eigen::Vector2d& faced) const
{
  const Eigen::Vector2d toFaced = faced - flat(solid.object.center());
  if (toFaced.norm() < kLeastDirection) return Eigen::Vector2d::Zero();
  if (!solid.isDirected) return toFaced.normalized();
  const Eigen::Matrix3d axes = solid.object.rotation();
  const Eigen::Vector3d s = solid.object.semiAxes();
  const bool isSquare = std::min(s.x(), s.y()) > kSquare * std::max(s.x(), s.y());
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0;
  for (const Eigen::Index axis : {0, 1})
  {
    if (!isSquare && s[axis] > s[1 - axis]) continue;  // a wide thing is looked at across
    const Eigen::Vector2d direction = flat(axes.col(axis)).normalized();
    const double towards = direction.dot(toFaced);
    if (std::abs(towards) <= most) continue;
    most = std::abs(towards);
    best = towards > 0 ? direction : Eigen::Vector2d(-direction);
  }
  return best;
}

/** How far the subject is beyond an object's front (sign = 1) or beyond its back (-1), (23.10) [m].
 */
std::optional<double> Geometry::onSide(const Solid& subject, const Solid& object, double sign) const
{
  const Eigen::Vector2d n = sign * object.front;
  if (n.isZero()) return std::nullopt;
  const auto halfAlong = [&](const Eigen::Vector2d& direction) {
    return cuboidHalfExtent(object.object, {direction.x(), direction.y(), 0});
  };
  const Eigen::Vector2d across(-n.y(), n.x());
  const Eigen::Vector2d way = flat(subject.object.center() - object.object.center());
  const double ahead = way.dot(n) - halfAlong(n);
  const double aside = std::abs(way.dot(across)) - halfAlong(across);
  if (ahead <= 0 || ahead > kFarthestFront || aside > ahead) return std::nullopt;
  return ahead;
}

std::optional<double> Geometry::inFrontOf(std::size_t i, std::size_t j) const
{
  if (i == j) return std::nullopt;
  return onSide(solids_[i], solids_[j], 1);
}

std::optional<double> Geometry::behind(std::size_t i, std::size_t j) const
{
  if (i == j) return std::nullopt;
  return onSide(solids_[i], solids_[j], -1);
}

std::optional<double> Geometry::between(std::size_t i, std::size_t j, std::size_t k) const
{
  if (i == j || i == k || j == k) return std::nullopt;
  const auto centre = [&](std::size_t at) { return flat(solids_[at].object.center()); };
  const Eigen::Vector2d way = centre(k) - centre(j), toSubject = centre(i) - centre(j);
  const double along = toSubject.dot(way);
  const double detour = toSubject.norm() + (centre(k) - centre(i)).norm() - way.norm();
  if (along <= 0 || along >= way.squaredNorm() || detour > kDetour * way.norm())
    return std::nullopt;  // (23.11)
  return detour;
}

}  // namespace quadmap
