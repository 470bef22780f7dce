#include "quadmap/navigation/ApproachPose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "FreeSpace.h"
#include "quadmap/base/OptionList.h"
#include "quadmap/geometry/CuboidExtent.h"
#include "quadmap/relations/Relations.h"

namespace quadmap
{
namespace
{
constexpr double kSmall = 1e-6;
constexpr double kOneFront = 0.5;   // the front is where this cosine is exceeded
constexpr double kStep = 0.05;      // between places that are tried [m]
constexpr double kAside = 0.5;      // how far from the middle of a side, as a share of its half
constexpr int kDirections = 16;     // around what has no sides
constexpr float kOccupied = 0.02F;  // probability that the cell is free

/** A side of an object that a robot may stand before. */
struct Side
{
  Eigen::Vector2d outward;  // unit vector
  double depth = 0;         // from the centre to the side [m]
  double halfWidth = 0;     // of the side [m]
  bool isUsual = true;
};

const MapObject& require(const CQuadricObjectMap& map, ObjectId id)
{
  const MapObject* object = map.find(id);
  if (!object) throw std::out_of_range("the map has no object " + std::to_string(id));
  return *object;
}

/** What has no direction is approached from anywhere. */
std::vector<Side> sidesAround(const MapObject& object)
{
  std::vector<Side> sides;
  const double radius = object.object.semiAxes().head<2>().maxCoeff();
  for (int i = 0; i < kDirections; ++i)
  {
    const double angle = 2 * M_PI * i / kDirections;
    sides.push_back({
        {std::cos(angle), std::sin(angle)},
        radius, 0, true
    });
  }
  return sides;
}

/** Which sides people use, (23.12). */
std::vector<Side> sidesOf(
    const CQuadricObjectMap& map, const MapObject& object, const DrivingOptions& options)
{
  if (!object.orientationDefined) return sidesAround(object);
  const LabelProperties label = map.labels().properties(object.label());
  const bool byLength = std::any_of(
      options.longSideLabels.begin(), options.longSideLabels.end(),
      [&](const std::string& name) { return map.labels().canonical(name) == label.name; });
  const auto front = frontOf(map, object.id);
  const bool facesTable = tableOf(map, object.id).has_value();
  const Eigen::Vector3d s = object.object.semiAxes();
  const Eigen::Matrix3d axes = object.object.rotation();
  std::vector<Side> sides;
  for (const Eigen::Index axis : {0, 1})
    for (const double sign : {1.0, -1.0})
    {
      Side side{sign * axes.col(axis).head<2>().normalized(), s[axis], s[1 - axis], true};
      if (byLength)
        side.isUsual = s[axis] <= s[1 - axis];
      else if (!label.levelTop && front)
        side.isUsual = (side.outward.dot(*front) > kOneFront) != facesTable;
      sides.push_back(side);
    }
  return sides;
}

/** Do a convex outline and a square with sides along x and y share more than a border? No line
 * along one of their sides parts them then.
 * \param half Half the side of the square [m] */
bool touches(const mrpt::math::TPolygon2D& outline, const Eigen::Vector2d& center, double half)
{
  const auto overlapAlong = [&](const Eigen::Vector2d& normal)
  {
    const double at = normal.dot(center), reach = half * normal.lpNorm<1>();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& corner : outline)
    {
      const double along = normal.dot(Eigen::Vector2d(corner.x, corner.y));
      low = std::min(low, along);
      high = std::max(high, along);
    }
    return low + kSmall < at + reach && at - reach + kSmall < high;
  };
  if (!overlapAlong(Eigen::Vector2d::UnitX()) || !overlapAlong(Eigen::Vector2d::UnitY()))
    return false;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const auto side = outline[(i + 1) % outline.size()] - outline[i];
    if (!overlapAlong(Eigen::Vector2d(-side.y, side.x).normalized())) return false;
  }
  return true;
}

class Approach
{
 public:
  Approach(const FreeSpace& space, const Eigen::Vector2d& center, const DrivingOptions& options) :
      space_(space), center_(center), options_(options)
  {
  }

  /** The place before a side with the shortest way, (23.13). */
  std::optional<ApproachPose> before(const Side& side) const
  {
    std::optional<ApproachPose> best;
    const double most = kAside * side.halfWidth;
    const int steps = static_cast<int>(most / kStep);
    for (int i = -steps; i <= steps; ++i)
      if (const auto found = nearestFree(side, i * kStep); found && isBetter(*found, best))
        best = found;
    return best;
  }

  static bool isBetter(const ApproachPose& found, const std::optional<ApproachPose>& best)
  {
    return !best || found.way < best->way;
  }

 private:
  /** As near to the side as is free. */
  std::optional<ApproachPose> nearestFree(const Side& side, double aside) const
  {
    const Eigen::Vector2d along(-side.outward.y(), side.outward.x());
    for (double gap = options_.gap; gap <= options_.farthest; gap += kStep)
    {
      const Eigen::Vector2d place =
          center_ + (side.depth + gap + options_.robotRadius) * side.outward + aside * along;
      if (const auto way = space_.wayTo(place))
        return ApproachPose{
            {place.x(), place.y(), std::atan2(-side.outward.y(), -side.outward.x())},
            side.isUsual,
            *way
        };
    }
    return std::nullopt;
  }

  const FreeSpace& space_;
  Eigen::Vector2d center_;
  const DrivingOptions& options_;
};

}  // namespace

void DrivingOptions::describe(OptionList& list)
{
  list.about("A robot on the floor, and how near it goes to things.");
  list.number("robotRadius", robotRadius, {kSmall, 100}, "m", "Of a circle around the robot.");
  list.number(
      "robotHeight", robotHeight, {kSmall, 100}, "m",
      "Objects that are higher above the floor than this are no obstacles.");
  list.number("gap", gap, {0, 100}, "m", "Left between the robot and the object.");
  list.number(
      "farthest", farthest, {0, 100}, "m", "Most that is left when nothing nearer is free.");
  list.number(
      "minFree", minFree, {kSmall, 1 - kSmall}, "",
      "Cells of the grid are free from this probability on; 0.5 is unknown.");
  list.requireLess("gap", "farthest");
}

std::optional<ApproachPose> approachPose(
    const CQuadricObjectMap& map,
    ObjectId id,
    const mrpt::math::TPose2D& robot,
    const mrpt::maps::COccupancyGridMap2D& grid,
    const DrivingOptions& options)
{
  const MapObject& object = require(map, id);
  const FreeSpace space(grid, {robot.x, robot.y}, options.robotRadius, options.minFree);
  const Approach approach(space, object.object.center().head<2>(), options);
  const auto sides = sidesOf(map, object, options);
  for (const bool usual : {true, false})
  {
    std::optional<ApproachPose> best;
    for (const Side& side : sides)
      if (side.isUsual == usual)
        if (const auto found = approach.before(side); found && Approach::isBetter(*found, best))
          best = found;
    if (best) return best;
  }
  return std::nullopt;
}

std::size_t footprintInto(
    const CQuadricObjectMap& map,
    mrpt::maps::COccupancyGridMap2D& grid,
    const DrivingOptions& options)
{
  const auto objects = map.confirmedObjects();
  double floor = std::numeric_limits<double>::infinity();
  for (const auto* object : objects) floor = std::min(floor, cuboidBottom(object->object));
  const double half = 0.5 * static_cast<double>(grid.getResolution());
  std::size_t written = 0;
  for (const auto* object : objects)
  {
    if (cuboidBottom(object->object) > floor + options.robotHeight) continue;
    const auto outline = map.footprint(object->id);
    mrpt::math::TPoint2D lower, upper;
    outline.getBoundingBox(lower, upper);
    for (int y = std::max(0, grid.y2idx(lower.y));
         y <= std::min(static_cast<int>(grid.getSizeY()) - 1, grid.y2idx(upper.y)); ++y)
      for (int x = std::max(0, grid.x2idx(lower.x));
           x <= std::min(static_cast<int>(grid.getSizeX()) - 1, grid.x2idx(upper.x)); ++x)
        if (touches(outline, {grid.idx2x(x), grid.idx2y(y)}, half))
        {
          grid.setCell(x, y, kOccupied);
          ++written;
        }
  }
  return written;
}

}  // namespace quadmap
