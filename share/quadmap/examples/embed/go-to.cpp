// Plans a way to an object: "go to the tv".
//   go-to MAP GRID.gridmap QUESTION X Y OUT.png      the robot stands at X Y [m]
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/nav/planners/PlannerSimple2D.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>

#include "quadmap/maps/MapFile.h"
#include "quadmap/navigation/ApproachPose.h"
#include "quadmap/relations/Questions.h"

using mrpt::img::TColor;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;

namespace
{
using Way = std::deque<TPoint2D>;

COccupancyGridMap2D gridFrom(const std::string& path)
{
  mrpt::io::CFileGZInputStream file(path);
  COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(file) >> grid;
  return grid;
}

/** The object that is asked for: "tv", "nearest chair to the tv". */
const quadmap::MapObject& askedFor(
    const quadmap::CQuadricObjectMap& map,
    const std::string& question,
    const mrpt::math::TPose2D& robot)
{
  quadmap::AnswerLimits limits;
  limits.place = Eigen::Vector3d(robot.x, robot.y, 0);
  const auto answer = quadmap::ask(map, question, limits);
  if (answer.found.empty()) throw std::runtime_error(answer.whyNothing);
  std::cout << "to " << quadmap::textOf(answer.found.front()) << "\n";
  return *map.find(static_cast<quadmap::ObjectId>(std::stoul(answer.found.front().item.record.id)));
}

/** Draws on the grid, seen from above. */
class Picture
{
 public:
  explicit Picture(const COccupancyGridMap2D& grid) : grid_(grid)
  {
    mrpt::img::CImage cells;
    grid.getAsImage(cells, false, true /*in colour*/);
    cells.scaleImage(
        image_, static_cast<unsigned>(cells.getWidth()) * kScale,
        static_cast<unsigned>(cells.getHeight()) * kScale, mrpt::img::IMG_INTERP_NN);
  }

  void line(const TPoint2D& a, const TPoint2D& b, const TColor& color, unsigned width)
  {
    image_.line(column(a), row(a), column(b), row(b), color, width);
  }
  void circle(const TPoint2D& at, double radius, const TColor& color)
  {
    image_.drawCircle(column(at), row(at), static_cast<int>(radius * pixels()), color, 2);
  }
  void outline(const mrpt::math::TPolygon2D& corners, const TColor& color)
  {
    for (std::size_t i = 0; i < corners.size(); ++i)
      line(corners[i], corners[(i + 1) % corners.size()], color, 2);
  }
  void text(const TPoint2D& at, const std::string& words, const TColor& color)
  {
    image_.textOut(column(at), row(at), words, color);
  }
  /** Writes the part from one corner of the map to the other. */
  void save(const std::string& path, const TPoint2D& lower, const TPoint2D& upper) const
  {
    const int left = std::max(0, column(lower)), top = std::max(0, row(upper));
    const int right = std::min(static_cast<int>(image_.getWidth()), column(upper));
    const int bottom = std::min(static_cast<int>(image_.getHeight()), row(lower));
    mrpt::img::CImage part;
    image_.extract_patch(
        part, static_cast<unsigned>(left), static_cast<unsigned>(top),
        static_cast<unsigned>(right - left), static_cast<unsigned>(bottom - top));
    if (!part.saveToFile(path)) throw std::runtime_error("cannot write " + path);
  }

 private:
  static constexpr unsigned kScale = 5;  // pixels of a cell

  double pixels() const { return kScale / static_cast<double>(grid_.getResolution()); }  // [1/m]
  int column(const TPoint2D& p) const
  {
    return static_cast<int>((p.x - static_cast<double>(grid_.getXMin())) * pixels());
  }
  int row(const TPoint2D& p) const
  {
    return static_cast<int>((static_cast<double>(grid_.getYMax()) - p.y) * pixels());
  }

  const COccupancyGridMap2D& grid_;
  mrpt::img::CImage image_;
};

void draw(
    const quadmap::CQuadricObjectMap& map,
    const COccupancyGridMap2D& grid,
    const Way& way,
    const mrpt::math::TPose2D& goal,
    double radius,
    const std::string& path)
{
  Picture picture(grid);
  for (const auto* object : map.confirmedObjects())
    picture.outline(map.footprint(object->id), TColor(40, 90, 200));
  for (std::size_t i = 1; i < way.size(); ++i)
    picture.line(way[i - 1], way[i], TColor(210, 40, 40), 3);
  picture.circle(way.front(), radius, TColor(30, 140, 60));
  picture.circle({goal.x, goal.y}, radius, TColor(210, 40, 40));
  const TPoint2D ahead(goal.x + radius * std::cos(goal.phi), goal.y + radius * std::sin(goal.phi));
  picture.line({goal.x, goal.y}, ahead, TColor(210, 40, 40), 3);
  for (const auto* object : map.confirmedObjects())
    picture.text(
        {object->object.center().x(), object->object.center().y()}, object->label(),
        TColor(235, 140, 20));
  const auto box = map.boundingBox();
  const double margin = 1.0;  // so that the walls are seen [m]
  picture.save(
      path, {box.min.x - margin, box.min.y - margin}, {box.max.x + margin, box.max.y + margin});
}

void run(char** argv)
{
  const auto map = quadmap::readMap(argv[1]);
  auto grid = gridFrom(argv[2]);
  const mrpt::math::TPose2D robot(std::stod(argv[4]), std::stod(argv[5]), 0);
  const quadmap::DrivingOptions options;

  quadmap::footprintInto(map, grid, options);
  const auto& object = askedFor(map, argv[3], robot);
  const auto goal = quadmap::approachPose(map, object.id, robot, grid, options);
  if (!goal) throw std::runtime_error("no free place before it can be reached");

  mrpt::nav::PlannerSimple2D planner;
  planner.robotRadius = static_cast<float>(options.robotRadius);
  Way way;
  bool isBlocked = false;
  planner.computePath(
      grid, mrpt::poses::CPose2D(robot), mrpt::poses::CPose2D(goal->pose), way, isBlocked);
  if (isBlocked) throw std::runtime_error("the planner finds no way");
  std::cout << "stand at " << goal->pose.x << " " << goal->pose.y << " m, look to "
            << goal->pose.phi << " rad; " << way.size() << " points lead there, " << goal->way
            << " m\n";
  way.emplace_front(robot.x, robot.y);
  draw(map, grid, way, goal->pose, options.robotRadius, argv[6]);
}
}  // namespace

int main(int argc, char** argv)
try
{
  if (argc != 7) throw std::runtime_error("usage: go-to MAP GRID.gridmap QUESTION X Y OUT.png");
  run(argv);
  return 0;
}
catch (const std::exception& e)
{
  std::cerr << "go-to: " << e.what() << "\n";
  return 1;
}
