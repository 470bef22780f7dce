#pragma once

#include <Eigen/Dense>
#include <cstddef>

namespace quadmap
{
/** How far what a run sees again may be from where it saw it before. */
class Drift
{
 public:
  virtual ~Drift() = default;

  /** How far two things of the map are moved, each from where it was seen before. */
  struct Moved
  {
    Eigen::Vector3d place;              //!< In the map [m]
    std::size_t before = 0, again = 0;  //!< Keyframes, in this order
  };
  /** Covariance of the moves of two things [m^2]: what both have between their keyframes moves
   * both. */
  virtual Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const = 0;
};

}  // namespace quadmap
