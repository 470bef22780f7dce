#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

namespace quadmap
{
/** A measured point of a surface. */
struct MeasuredPoint
{
  Eigen::Vector3f position;  //!< In the map [m]
  Eigen::Vector3f toCamera;  //!< Unit, in the map
  Eigen::Vector3f rgb;       //!< In [0, 255]
  float weight = 1;          //!< Inverse of the variance of its depth, > 0
};

/** The weighted mean of the points of each cubic cell of space. The cells are in the order in which
 * they were first hit. */
class PointGrid
{
 public:
  explicit PointGrid(double cellSize) : cellSize_(static_cast<float>(cellSize)) {}

  void add(const MeasuredPoint& point);

  std::size_t size() const { return cells_.size(); }

  /** The cells with at least `hits` points and this share of the weight of the heaviest of the
   * cells around them, ascending. The noise of a surface puts some points beside it, into cells of
   * little weight. */
  std::vector<std::size_t> strongCells(std::uint32_t hits, float share) const;

  Eigen::Vector3f position(std::size_t cell) const;
  Eigen::Vector3f toCamera(std::size_t cell) const { return cells_[cell].toCameraSum; }
  std::array<std::uint8_t, 3> rgb(std::size_t cell) const;
  float weight(std::size_t cell) const { return cells_[cell].weight; }

 private:
  using Key = std::array<std::int32_t, 3>;
  struct Cell
  {
    Key key;  // its corner of least coordinates [cells]; offsets are from there
    Eigen::Vector3f offsetSum = Eigen::Vector3f::Zero(), rgbSum = Eigen::Vector3f::Zero();
    Eigen::Vector3f toCameraSum = Eigen::Vector3f::Zero();
    float weight = 0;
    std::uint32_t hits = 0;
  };

  std::size_t slotOf(const Key& key) const;
  void enlarge();
  float heaviestAround(const Key& key) const;

  float cellSize_;
  std::vector<std::uint32_t> slots_;  // 1 + index of a cell, 0 where none is; a power of two
  std::vector<Cell> cells_;
};

}  // namespace quadmap
