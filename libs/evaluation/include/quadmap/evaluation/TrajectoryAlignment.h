#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <string>
#include <vector>

#include "quadmap/obs/Trajectory.h"

namespace quadmap
{
/** The same moment in the true and in the estimated trajectory. */
struct PosePair
{
  mrpt::poses::CPose3D T_truth_body;      //!< In the world of the true trajectory
  mrpt::poses::CPose3D T_estimated_body;  //!< In the estimated map
  double time = 0;                        //!< Of the estimated pose [s]
};

/** The association of `evo_ape`: every pose of the shorter trajectory (of equally long ones, the
 * estimated) with the one of the other that is nearest in time, the earlier of two equally near.
 * Neither trajectory needs to be sorted; the pairs are in the order of time.
 * \param maxTimeDifference Pairs farther apart [s] are left out. */
std::vector<PosePair> pairByTime(
    const Trajectory& truth, const Trajectory& estimated, double maxTimeDifference = 0.02);

/** What a rotation between two worlds was taken from. */
enum class AlignmentSource
{
  Positions,    //!< Umeyama without scale
  Orientations  //!< The positions alone leave it open: the bodies' axes were used as well
};

struct TrajectoryAlignment
{
  mrpt::poses::CPose3D T_truth_estimated;
  AlignmentSource source = AlignmentSource::Positions;
  /** Extent of the positions in the second of their principal directions: the square root of the
   *  second singular value of their cross-covariance [m]. */
  double secondSpread = 0;
};

/** Below this `secondSpread` the positions (a point, a straight line) do not determine the
 * rotation: with positions good to 1 cm it would be worse than half a radian / sqrt(pairs) [m]. */
constexpr double kMinSecondSpread = 0.02;

/** The rigid motion that carries the estimated positions to the true ones with the least sum of
 * squares (Umeyama 1991 without scale).
 *
 * Where the positions do not determine it, the rotation R maximises the agreement of positions and
 * of body axes, tr(R^t (sum p_truth p_estimated^t + w sum R_truth B^t R_estimated^t)), w = 1 m^2.
 * B is the identity, or the optical axes in a robot's (x forward) when the truth follows the
 * optical frame and this agrees better. \exception std::invalid_argument If there are no pairs. */
TrajectoryAlignment alignTrajectories(const std::vector<PosePair>& pairs);

/** Umeyama without scale on the positions alone, as `evo_ape --align`. Where they leave the
 * rotation open this is one of the equally good ones: good for ateRmse(), useless for objects.
 * \exception std::invalid_argument If there are no pairs. */
mrpt::poses::CPose3D alignPositions(const std::vector<PosePair>& pairs);

/** Root mean square distance of the paired positions after alignment [m].
 * \exception std::invalid_argument If there are no pairs. */
double ateRmse(const std::vector<PosePair>& pairs, const mrpt::poses::CPose3D& T_truth_estimated);

}  // namespace quadmap
