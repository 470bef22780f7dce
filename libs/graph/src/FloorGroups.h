#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

namespace quadmap
{
/** Variance of one place's height relative to another's, from the steps between them:
 * doc/mathematics.md, (16.11). */
class HeightDrift
{
 public:
  /** Adds the next pose. \param step To it from the pose before; null: nothing joins the two. */
  void add(const Eigen::Vector2d& position, const mrpt::poses::CPose3DPDFGaussian* step);

  /** \param from, to Numbers of poses, from <= to. \param at Place that is seen from `to`, x and y.
   *  \return Variance of its height as seen from `from` [m^2]. */
  double variance(std::size_t from, std::size_t to, const Eigen::Vector2d& at) const;

 private:
  struct Sums  // over the steps up to a pose
  {
    double height = 0, angle = 0;                          // of variances [m^2], [rad^2]
    Eigen::Vector2d anglePlace = Eigen::Vector2d::Zero();  // of angle variances times places
    double anglePlaceSquare = 0;                           // ... times squared norms
  };
  std::vector<Sums> sums_;
};

/** A thing that stands on a floor, by its label. */
struct StandingThing
{
  double bottom = 0;    //!< Its height [m]
  double variance = 0;  //!< Of it, given the poses that see the thing [m^2]
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  //!< x and y [m]
  std::vector<std::size_t> poses;                   //!< That see it, ascending, at least one
};

/** Which things stand on the same floor. Two heights are two floors when neither the measurements
 * nor the drift between the poses explains their difference, or when it is more than half a storey:
 * doc/mathematics.md, (16.12).
 * \return Number of the floor of each thing, from 0 on. */
std::vector<std::size_t> floorsOf(
    const std::vector<StandingThing>& things, const HeightDrift& drift);

}  // namespace quadmap
