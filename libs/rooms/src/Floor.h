#pragma once

#include <vector>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** A rectangle on the floor, from some height to another, that stands upright. */
struct UprightBox
{
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  //!< [m]
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    //!< Half sizes [m]
  double yaw = 0;                                    //!< [rad]
  double low = 0, high = 0;                          //!< Heights [m]

  /** Distance of a point of the floor plan, 0 inside [m]. */
  double distanceTo(const Eigen::Vector2d& p) const;
};

/** Whether two boxes have a common volume, when the second is grown by `gap` to all sides but up
 * and down. By separating axes. Boxes that touch do not overlap. */
bool overlap(const UprightBox& a, const UprightBox& b, double gap = 0);

/** A box around all of an object, and one around each of its parts. */
UprightBox boundsOf(const SceneObject& object);
std::vector<UprightBox> partBoxes(const SceneObject& object);

/** Whether parts of two objects overlap, each taken as the box around it: never too little. */
bool collide(const SceneObject& a, const SceneObject& b);

/** Whether a box is inside the walls, the floor and the ceiling. */
bool isInside(const UprightBox& box, const Room& room);

/** The box grown by so much to each side of the floor, not up and down [m]. */
UprightBox grown(UprightBox box, double by);

}  // namespace quadmap::simulator
