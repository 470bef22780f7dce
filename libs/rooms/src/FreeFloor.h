#pragma once

#include <vector>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** The cells of the floor where somebody can stand and that are connected with each other. */
class FreeFloor
{
 public:
  /** \param margin To walls and to all that is below `headroom` [m]. */
  FreeFloor(const Scene& scene, double margin, double headroom);

  /** Area of the largest connected part, which is all that is kept [m^2]. */
  double area() const;
  const std::vector<Eigen::Vector2d>& places() const { return places_; }
  bool isFree(const Eigen::Vector2d& p) const;

  /** Cells from one place to another, both included, by a short way that keeps away from things.
   * Indices of places(). */
  std::vector<std::size_t> way(std::size_t from, std::size_t to) const;

 private:
  int cellOf(const Eigen::Vector2d& p) const;  // -1 outside
  void keepLargestPart(const std::vector<double>& clearance, double margin);

  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<int> placeOfCell_;  // -1: taken
  std::vector<int> cellOfPlace_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<double> clearance_;  // of each place to the next thing [m]
};

}  // namespace quadmap::simulator
