#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <string>
#include <vector>

#include "quadmap/obs/Trajectory.h"

namespace quadmap
{
/** A true and an estimated pose of the same time. */
struct PosePair
{
  mrpt::poses::CPose3D T_truth_body;      //!< In the world of the true trajectory
  mrpt::poses::CPose3D T_estimated_body;  //!< In the estimated map
  double time = 0;                        //!< Time of the estimated pose [s]
};

/** Pairs poses as `evo_ape` does. Each pose of the shorter trajectory is paired with the pose of
 * the other one that is nearest in time. Of equally long trajectories the estimated one counts as
 * the shorter, and of two equally near poses the earlier one is taken. The trajectories need not be
 * sorted. The pairs are in the order of time.
 * \param maxTimeDifference Pairs with a larger difference of their times are left out [s]. */
std::vector<PosePair> pairByTime(
    const Trajectory& truth, const Trajectory& estimated, double maxTimeDifference = 0.02);

/** What a rotation between two worlds was taken from. */
enum class AlignmentSource
{
  Positions,    //!< Umeyama without scale
  Orientations  //!< The positions alone leave it open, and the bodies' axes helped
};

struct TrajectoryAlignment
{
  mrpt::poses::CPose3D T_truth_estimated;
  AlignmentSource source = AlignmentSource::Positions;
  /** Extent of the positions in the second of their principal directions: the square root of the
   *  second singular value of their cross-covariance [m]. */
  double secondSpread = 0;
  /** Below this `secondSpread` the positions do not determine the rotation [m]. */
  double leastSpread = 0;
};

/** The positions (a point, a straight line) do not determine the rotation when their `secondSpread`
 * is below this [m]. With positions good to 1 cm the rotation would be worse than
 * 0.5 rad / sqrt(pairs). */
constexpr double kMinSecondSpread = 0.02;

/** Neither do they when `secondSpread` is below so many times their ATE: errors of a drifting
 * trajectory are not independent, and turn it about its long axis by as much as their ratio. */
constexpr double kMinSpreadPerError = 10;

/** The rigid motion that carries the estimated positions to the true ones with the least sum of
 * squares (Umeyama 1991 without scale): doc/mathematics.md, (20.1).
 *
 * Where the positions do not determine it, the rotation R maximises the agreement of positions and
 * of body axes, tr(R^t (sum p_truth p_estimated^t + w sum R_truth B^t R_estimated^t)), w = 1 m^2.
 * B is the identity, or the optical axes in a robot's (x forward) when the truth follows the
 * optical frame and this agrees better. \exception std::invalid_argument If there are no pairs. */
TrajectoryAlignment alignTrajectories(const std::vector<PosePair>& pairs);

/** Umeyama without scale on the positions alone, as `evo_ape --align`. Where the positions leave
 * the rotation open, the result is one of the equally good ones. It serves ateRmse() but not
 * objects. \exception std::invalid_argument If there are no pairs. */
mrpt::poses::CPose3D alignPositions(const std::vector<PosePair>& pairs);

/** ATE, the root mean square distance of the paired positions after alignment [m]:
 * doc/mathematics.md, (20.2).
 * \exception std::invalid_argument If there are no pairs. */
double ateRmse(const std::vector<PosePair>& pairs, const mrpt::poses::CPose3D& T_truth_estimated);

}  // namespace quadmap
