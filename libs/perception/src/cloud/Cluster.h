#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "cloud/ObjectCloud.h"

namespace quadmap
{
/** An interval along an axis of the image [cells]. */
struct Span
{
  double from = 0, to = 0;
  double length() const { return to - from; }
  double common(const Span& other) const
  {
    return std::min(to, other.to) - std::max(from, other.from);
  }
};

/** One cluster of a box's candidates, with what tells whether it is the object. */
struct Cluster
{
  int count = 0;                                    // cells
  double centrality = 0;                            // sum of Gaussian weights of its cells
  double x1 = 1e9, y1 = 1e9, x2 = -1e9, y2 = -1e9;  // bounds [cells]
  double nearest = 1e9, farthest = 0;               // depth [m]
  int leaking = 0;                                  // cells where it goes on outside the box
  double fill = 0;                                  // IoU of its bounds and the box
  double leak = 0;  // share of the box's outline across which it goes on

  void add(const ObjectCloud::Cell& cell, double z, double weight)
  {
    ++count;
    centrality += weight;
    x1 = std::min(x1, double(cell.c));
    y1 = std::min(y1, double(cell.r));
    x2 = std::max(x2, double(cell.c));
    y2 = std::max(y2, double(cell.r));
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  /** Its bounds along the image axis that is nearer to horizontal. \param down In the image. */
  Span across(const Eigen::Vector2d& down) const
  {
    return std::abs(down.x()) > std::abs(down.y()) ? Span{y1, y2} : Span{x1, x2};
  }
  double lowest(const Eigen::Vector2d& down) const  //!< Along the other one, to its lower end
  {
    if (std::abs(down.x()) > std::abs(down.y())) return down.x() > 0 ? x2 : -x1;
    return down.y() > 0 ? y2 : -y1;
  }
  /** How well the cluster explains the box, equation (7.4). */
  double score() const { return centrality * fill * (1.0 - leak) * (1.0 - leak); }
};

/** Is a cluster a part of the object that something thin or unseen joins to the main cluster, such
 * as a leg, or the leaves above a stem? Such a part ends within the box and lies at the depth of
 * the main cluster, and the background does not. A main cluster that fills its box needs no such
 * part: what is seen over a bed is not the bed's. */
bool isFragment(const Cluster& cluster, const Cluster& main);

/** Is a cluster the front of the object? An example is a chair whose seat is seen at too flat an
 * angle for the sensor. Its front is a broad part, nearer than the main cluster, that ends within
 * the box and reaches lower. What hides an object goes on outside the object's box, or is narrower.
 * \param down In the image. */
bool isFront(const Cluster& cluster, const Cluster& main, const Eigen::Vector2d& down);

}  // namespace quadmap
