#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

namespace quadmap
{
/** A coloured point of a surface. */
struct CloudPoint
{
  Eigen::Vector3f position;  //!< In the map [m]
  Eigen::Vector3f normal;    //!< Unit, towards the camera
  std::array<std::uint8_t, 3> rgb{};
};
using Cloud = std::vector<CloudPoint>;

/** Collects the points of many RGB-D frames and thins them out: each cubic cell keeps one point,
 * the mean of its points. Memory is bounded, because cells grow when there are too many of them. */
class CloudCollector
{
 public:
  /** \param cellSize Edge of a cell [m], > 0. \param maxPoints Largest number of points to keep, >
   * 0. */
  CloudCollector(double cellSize, std::size_t maxPoints);

  /** Which points of a frame are used. */
  struct Selection
  {
    double maxRange = 4.5;  //!< Depth beyond this is ignored [m], > 0
    int stride = 1;         //!< Every n-th row and column of pixels, > 0
  };

  /** Adds a frame that was taken from the robot's pose `T_map_robot`. The scan's images must be
   *  loaded. Its points are computed, and freed again. */
  void add(
      mrpt::obs::CObservation3DRangeScan& scan,
      const mrpt::poses::CPose3D& T_map_robot,
      const Selection& selection);

  /** Grows the cells until they have several points on average, so that surfaces look closed.
   *  \param largest Largest size of a cell [m]. */
  void closeGaps(double largest);

  Cloud points() const;
  double cellSize() const { return cellSize_; }  //!< Present size of a cell [m]

 private:
  struct Cell
  {
    Eigen::Vector3f positionSum = Eigen::Vector3f::Zero(), normalSum = Eigen::Vector3f::Zero();
    Eigen::Vector3f rgbSum = Eigen::Vector3f::Zero();
    float count = 0;
  };
  /** The cells by their keys, one after the other in memory, in the order in which they were hit.
   */
  class Cells
  {
   public:
    struct Entry
    {
      Eigen::Vector3i key;
      Cell cell;
    };
    Cell& operator[](const Eigen::Vector3i& key);  //!< It is made when there is none
    std::size_t size() const { return entries_.size(); }
    const std::vector<Entry>& entries() const { return entries_; }

   private:
    std::size_t slotOf(const Eigen::Vector3i& key) const;
    void enlarge();

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> slots_;  //!< 1 + index of an entry, 0 where none is; a power of two
  };

  void addPoints(
      mrpt::obs::CObservation3DRangeScan& scan,
      const mrpt::poses::CPose3D& T_map_robot,
      const Selection& selection);
  Eigen::Vector3i keyOf(const Eigen::Vector3f& p_map) const;
  void growCells();

  double cellSize_;
  std::size_t maxPoints_;
  Cells cells_;
  std::size_t frames_ = 0;
};

}  // namespace quadmap
