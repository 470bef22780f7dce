#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "cloud/ObjectCloud.h"
#include "cuboid/HeadingEstimate.h"
#include "quadmap/geometry/Plane.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** A point of the rim of a level top. */
struct RimPoint
{
  Eigen::Vector2d p;    //!< In the frame `upright`, from the camera [m]
  Eigen::Vector2d out;  //!< One cell farther out, on the same plane [m]
};

/** Where the level top of an object (a table) ends, seen from above. A ray that passes beyond the
 * rim meets something below the top's plane; one that meets something above it is blocked, and what
 * is cut by the image's border or without depth shows no rim either. */
class TopRim
{
 public:
  /** \param top Of the object, optical frame, normal up; the camera is above it.
   *  \param R_upright_optical Turns points into the frame `upright` of UprightCloud.h. */
  TopRim(
      const DepthCloud& cloud,
      const ObjectCloud& object,
      const Plane& top,
      const Eigen::Matrix3d& R_upright_optical,
      const PerceptionOptions& options);

  /** The heading that the straight parts of the rim have in common, in the frame `upright`. Nothing
   * when too little of the rim shows, or most of it is not straight (a round table). */
  std::optional<HeadingEstimate> heading() const;

  /** One side of the top that shows. */
  struct Side
  {
    double position = 0;  //!< Along the outward normal, from the camera [m]
    double shift = 0;     //!< Of the part that shows from the camera, along the side [m]
    double perCell = 0;   //!< What one cell of the depth image spans along the normal [m]
  };
  /** \param normal Outward normal, unit, in the frame `upright`. Nothing when the top does not show
   * its end there. */
  std::optional<Side> side(const Eigen::Vector2d& normal) const;

 private:
  /** Those that look out along a normal and lie on the straight side there. */
  std::vector<RimPoint> sidePoints(const Eigen::Vector2d& normal) const;

  std::vector<RimPoint> rim_;
};

}  // namespace quadmap
