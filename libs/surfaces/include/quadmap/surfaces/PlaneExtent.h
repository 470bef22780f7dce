#pragma once

#include <Eigen/Dense>
#include <vector>

namespace quadmap
{
/** How far a surface reaches: the convex hull of where it was seen, in coordinates along it. Things
 * that stand on a surface hide parts of it; the hull closes them. */
class PlaneExtent
{
 public:
  PlaneExtent() = default;  //!< Reaches everywhere, as a floor does

  /** \param normal Unit normal of the surface. \param points At least one [m]. */
  PlaneExtent(const Eigen::Vector3d& normal, const std::vector<Eigen::Vector3d>& points);

  /** How far the foot of a point is outside [m]; negative inside. */
  double outside(const Eigen::Vector3d& p) const;

  /** From a point along the surface to the nearest one above the extent [m]; zero inside. */
  Eigen::Vector3d toExtent(const Eigen::Vector3d& p) const;

  /** Is outside() below a margin [m], >= 0? Mostly known from the sides alone, in a fifth of the
   * time. */
  bool isWithin(const Eigen::Vector3d& p, double margin) const;

  double area() const;  //!< [m^2]; 0 for one that reaches everywhere

  bool isEverywhere() const { return corners_.empty(); }

 private:
  struct Side
  {
    Eigen::Vector2d outwards;  // unit
    double offset;             // outwards.q is less inside [m]
  };

  struct Rim
  {
    bool isInside = false;
    Eigen::Vector2d step = Eigen::Vector2d::Zero();  // from a point to the nearest of the rim [m]
  };
  Rim nearestRim(const Eigen::Vector2d& q) const;

  Eigen::Matrix<double, 2, 3> along_ = Eigen::Matrix<double, 2, 3>::Zero();
  std::vector<Eigen::Vector2d> corners_;  // counter-clockwise
  std::vector<Side> sides_;               // between them
};

}  // namespace quadmap
