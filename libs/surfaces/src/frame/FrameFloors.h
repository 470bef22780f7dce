#pragma once

#include "quadmap/surfaces/ScenePlanes.h"

// Which of the planes of a frame are floors: doc/mathematics.md, 5, "Several floors".

namespace quadmap
{
inline constexpr double kMaxBelowFloor = 0.03;  // share of a frame's points: noise, reflections

/** Share of the cloud's points that lie more than `margin` behind (below) the plane. */
double shareBelow(const DepthCloud& cloud, const Plane& plane, double margin);

/** Marks as furniture what is large enough for a floor, but has something under it away from its
 * rim. Floors and platforms are closed, while one can look under a table. */
void markHollow(ScenePlanes& planes, const DepthCloud& cloud, const SurfaceOptions& options);

/** The floor that other frames know replaces a higher one of this frame. Of two that the frame
 * shows, both are floors. The known one is not there when the frame shows something below it and
 * nothing of it. */
void useKnownFloor(ScenePlanes& planes, const DepthCloud& cloud, const Plane& known);

/** Is a known surface, which is no furniture, a floor although the floor of the frame is another
 * one? Platforms, landings and other storeys are: they are large enough to stand on.
 * \param point On it. \param area [m^2] */
bool isFloorThatEnds(const ScenePlanes& planes, const Eigen::Vector3d& point, double area);

}  // namespace quadmap
