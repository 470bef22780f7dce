#pragma once

#include <Eigen/Dense>
#include <vector>

namespace quadmap
{
/** Corners of the convex hull of points in a plane, counter-clockwise, by Andrew's monotone chain.
 * Points on a side are no corners. \param points At least one; they need no order. */
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/** z of the cross product of two vectors in a plane; > 0 when b is to the left of a. */
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace quadmap
