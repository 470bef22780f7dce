#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <optional>

namespace quadmap
{
using PoseCovariance = Eigen::Matrix<double, 6, 6>;  //!< Of (x, y, z, yaw, pitch, roll)

/** Covariance Q of the step that turned the covariance of `from` into that of `to`:
 *    P_to = J_from P_from J_from^t + J_step Q J_step^t
 * It is nothing when no covariance Q does so. doc/mathematics.md, (15.2). */
std::optional<PoseCovariance> addedCovariance(
    const mrpt::poses::CPose3DPDFGaussian& from, const mrpt::poses::CPose3DPDFGaussian& to);

/** Covariance of a pose reached from `from` by a step with covariance Q, (15.2) the other way. */
PoseCovariance covarianceAfterStep(
    const mrpt::poses::CPose3DPDFGaussian& from,
    const mrpt::poses::CPose3D& T_from_to,
    const PoseCovariance& Q);

}  // namespace quadmap
