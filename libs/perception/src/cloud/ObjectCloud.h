#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/ScenePlanes.h"
#include "quadmap/surfaces/WallDistance.h"

namespace quadmap
{
/** Which cells of the depth cloud belong to something, in a part of it. */
class CellMask
{
 public:
  CellMask() = default;
  explicit CellMask(const DepthCloud::CellRange& range) :
      range_(range), own_(static_cast<std::size_t>(range.cells()), 0)
  {
  }

  bool contains(int c, int r) const { return range_.contains(c, r) && own_[index(c, r)] != 0; }
  /** Does it contain the eight cells around one, at a distance of `step`? */
  bool surrounds(int c, int r, int step) const
  {
    if (c - step < range_.c0 || r - step < range_.r0 || c + step >= range_.c1 ||
        r + step >= range_.r1)
      return false;
    const std::size_t across = static_cast<std::size_t>(step);
    const std::size_t down = across * static_cast<std::size_t>(range_.c1 - range_.c0);
    const char* own = &own_[index(c, r)];
    const char *above = own - down, *below = own + down;
    return above[0] && below[0] && *(own - across) && own[across] && *(above - across) &&
           above[across] && *(below - across) && below[across];
  }
  /** Cells outside the range are left out. */
  void insert(int c, int r)
  {
    if (range_.contains(c, r)) own_[index(c, r)] = 1;
  }
  /** A rectangle within the range. \param c, r Its first cell. */
  void insert(int c, int r, int columns, int rows)
  {
    for (int i = 0; i < rows; ++i)
      std::fill_n(own_.begin() + static_cast<std::ptrdiff_t>(index(c, r + i)), columns, char(1));
  }
  template <typename Visit>
  void forEach(const Visit& visit) const  //!< Calls visit(c, r) for all cells.
  {
    const DepthCloud::CellRange range = range_;  // its own: a visit cannot change it
    const char* own = own_.data();
    for (int r = range.r0; r < range.r1; ++r)
      for (int c = range.c0; c < range.c1; ++c)
        if (*own++ != 0) visit(c, r);
  }

 private:
  std::size_t index(int c, int r) const
  {
    return static_cast<std::size_t>((r - range_.r0) * (range_.c1 - range_.c0) + c - range_.c0);
  }

  DepthCloud::CellRange range_;
  std::vector<char> own_;  // not bool: bytes are faster
};

/** The part of a depth image that one detected object is made of. */
struct ObjectCloud
{
  struct Cell
  {
    int c, r;
  };
  /** In the depth cloud: every step-th of every step-th row, and of those along the rim, which
   * `mask` has all, every step-th. */
  std::vector<Cell> cells;
  int step = 1;
  std::vector<Eigen::Vector3d> points;  //!< Of these cells, optical frame [m]
  CellMask mask;                        //!< All its cells
  std::optional<int> support;           //!< Plane it stands on, index in ScenePlanes
  std::optional<WallDistance> onWall;   //!< Of things that usually hang on walls, and do
  std::optional<Plane> top;             //!< Where its kind ends in a horizontal surface; normal up
  double coverage = 0;                  //!< Share of the box's cells with valid depth
  ImageBox box;                         //!< Of the detector [px]
  DepthCloud::CellRange inBox;          //!< The cells of this box; some lie around it
  double leak = 0;  //!< Share of the box's outline across which the surface goes on outside

  bool empty() const { return points.empty(); }
};

/** Do two boxes of one frame show the same thing, perhaps under two labels? One does not hide the
 * other then. AgreementOptions::duplicateIoU asks for more, as a box is dropped by it. */
inline bool showOneThing(const ImageBox& a, const ImageBox& b) { return imageBoxIoU(a, b) > 0.55; }

/** Coordinates of some points [m], enough of them for a quantile of the middle.
 * \param axis 0 to 2. */
std::vector<double> sampleOf(const std::vector<Eigen::Vector3d>& points, int axis);

/** One detection of the frame, with what is known about it before its points are cut out. */
struct ObjectTask
{
  const DetectedObject* detection = nullptr;  //!< Never null
  LabelProperties label;
  std::optional<int> support = {};  //!< Plane it stands on, index in ScenePlanes
  std::optional<int> wall = {};     //!< Plane it hangs on, index in ScenePlanes
};

/** Cuts the objects of a frame out of their boxes. Of each box the support, the walls around and
 * planes that reach far beyond it are removed; the rest falls into clusters, and the one that fills
 * the box best and ends there is the object, with fragments at its depth. What stands alone in its
 * own box is no part of the other boxes' objects (doc/mathematics.md).
 * \return One for each task; empty where there is no such cluster. */
std::vector<ObjectCloud> segmentObjects(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<ObjectTask>& tasks,
    const PerceptionOptions& options);

}  // namespace quadmap
