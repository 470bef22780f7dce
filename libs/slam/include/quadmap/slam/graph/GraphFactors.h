#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <memory>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/graph/GraphState.h"
#include "quadmap/slam/graph/RobotView.h"

namespace ceres
{
class CostFunction;
}

namespace quadmap
{
/** The factors of the graph (doc/mathematics.md, "The graph"). Residuals are in standard
 * deviations. Huber's kernel is inside: a residual r beyond the threshold h enters as
 * sign(r) sqrt(2 h |r| - h^2), half the square of which is Huber's cost. */
using Factor = std::unique_ptr<ceres::CostFunction>;

/** T_from_to; six residuals. Blocks: pose `from`, pose `to`.
 * \param step With its full covariance, in MRPT's order. \exception std::invalid_argument If it is
 * not positive definite. */
Factor createOdometryFactor(const mrpt::poses::CPose3DPDFGaussian& step);

/** A pose known from elsewhere. Block: the pose. */
Factor createPosePrior(const mrpt::poses::CPose3DPDFGaussian& T_map_robot);

/** One measurement of an object: its faces, yaw (all three angles of a free object), tilt, box
 * edges and seed. Exact derivatives. Lower bounds of sizes come under Cauchy's kernel. Blocks:
 * pose, object. \param shapeExponent Of the label, for the box edges. \param huber In sigmas. */
Factor createViewFactor(
    const RobotView& view, double shapeExponent, double huber, ObjectFreedom freedom);

/** Typical size of the label, and roundness where the label has no direction. Block: object. */
Factor createLabelPrior(
    const LabelProperties& label, const EstimatorOptions& options, ObjectFreedom freedom);

/** The object's lowest point is at a height. Blocks: object, height (1) [m].
 * \param sigma [m]. */
Factor createFloorFactor(double sigma, double huber, ObjectFreedom freedom);

/** An object stands on another one: the bottom of the first is at the top of the second. Blocks:
 * upper object, lower object; both upright. */
Factor createStandsOnFactor(double sigma, double huber);

/** Gaussian knowledge of an object: 1/2 d^t L d + g^t d, d the step from `at`. Block: object.
 * L may be singular (positive semidefinite). */
struct ObjectPrior
{
  ObjectBlock at{};
  Eigen::MatrixXd L;
  Eigen::VectorXd g;
  /** Cauchy's kernel c of the whole residual r, for knowledge that may be wrong: |r|^2 becomes
   * c^2 ln(1 + |r|^2 / c^2); 0: none. [sigmas] */
  double cauchy = 0;
};
Factor createObjectPrior(const ObjectPrior& prior, ObjectFreedom freedom);

}  // namespace quadmap
