#pragma once

#include <Eigen/Dense>
#include <vector>

namespace quadmap
{
/** Corners of a convex polygon in the plane of the floor, counter-clockwise [m]. */
using Footprint = std::vector<Eigen::Vector2d>;

double areaOf(const Footprint& polygon);  //!< [m^2]

/** Area that two convex polygons share [m^2]. */
double sharedArea(const Footprint& a, const Footprint& b);

/** Smallest distance of two convex polygons; 0 where they touch or overlap [m]. */
double distanceBetween(const Footprint& a, const Footprint& b);

}  // namespace quadmap
