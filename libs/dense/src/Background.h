#pragma once

#include <map>
#include <utility>
#include <vector>

#include "BackgroundPlanes.h"

namespace quadmap
{
/** What an object stands on and at. */
class Background
{
 public:
  /** \param clearance Points nearer to a plane belong to it [m]; up to twice as much where the
   * plane is rough. */
  explicit Background(double clearance) : clearance_(clearance) {}

  void add(const std::vector<BackgroundPlane>& walls);

  /** Adds what the object stands on, with the noise above it: see contains().
   *  \param near All points about the object.
   *  \param candidates Those in its boxes. */
  void addSupport(
      const BackgroundPlane& support,
      const std::vector<NearPoint>& near,
      const std::vector<NearPoint>& candidates);

  /** Whether a point belongs to a plane, or lies low above a place where the support itself was
   * seen. What stands there would hide it, so that the point is noise of the support. */
  bool contains(const Eigen::Vector3d& p) const;

 private:
  /** Weights of the points of the support and of those low above it, over a square of its plan. */
  struct Column
  {
    double support = 0, low = 0;
  };
  using Square = std::pair<int, int>;

  static Square squareOf(const Eigen::Vector3d& p);
  double clearanceOf(const BackgroundPlane& plane) const;
  bool isNoise(const Eigen::Vector3d& p) const;

  double clearance_;
  std::vector<BackgroundPlane> planes_;
  BackgroundPlane support_;
  std::map<Square, Column> columns_;  //!< Empty without a support, and for things that are low
};

}  // namespace quadmap
