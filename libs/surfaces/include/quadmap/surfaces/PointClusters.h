#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
/** Connected components of points in the optical frame. Points hang together when they share a cell
 * of a grid or lie in cells that touch; the cells are `gap` wide, and along the depth at least as
 * long as the noise there, so that a far surface does not fall apart into layers. */
class PointClusters
{
 public:
  /** \param gap Points nearer to each other than this are always together [m], > 0. */
  PointClusters(
      const std::vector<Eigen::Vector3d>& points, double gap, const SurfaceOptions& options);

  /** Makes one cluster of those that a pair of points (their indices) belongs to. */
  void join(const std::vector<std::pair<int, int>>& pairs);

  int count() const { return count_; }
  const std::vector<int>& labels() const { return labels_; }  //!< Of each point, in [0, count)

 private:
  int count_ = 0;
  std::vector<int> labels_;
};

}  // namespace quadmap
