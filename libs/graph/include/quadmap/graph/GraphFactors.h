#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <memory>

#include "quadmap/estimation/BoxMeasurement.h"
#include "quadmap/graph/GraphState.h"
#include "quadmap/obs/LabelTable.h"

namespace ceres
{
class CostFunction;
}

namespace quadmap
{
/** The factors of the graph (doc/mathematics.md, "The graph"). Residuals are in standard
 * deviations. The robust kernels are inside (doc/mathematics.md, (16.6) and (16.7)), so that half
 * the sum of the squares is the robust cost. */
using Factor = std::unique_ptr<ceres::CostFunction>;

/** T_from_to; six residuals, doc/mathematics.md, (16.2). Blocks: pose `from`, pose `to`.
 * \param step With its full covariance, in MRPT's order. \exception std::invalid_argument If it is
 * not positive definite. */
Factor createOdometryFactor(const mrpt::poses::CPose3DPDFGaussian& step);

/** One measurement of an object: the rows of ViewAtPose. Blocks: pose, object. \param view It must
 * outlive the factor, as a graph has many. \param shapeExponent Of the label, for the box edges.
 * \param huber In sigmas. */
Factor createViewFactor(
    const BoxMeasurement& view, double shapeExponent, double huber, ObjectFreedom freedom);

/** What the label alone says of the sizes, doc/mathematics.md, (11.17) and (11.18). Block: object.
 */
Factor createLabelPrior(
    const LabelProperties& label, const EstimatorOptions& options, ObjectFreedom freedom);

/** The object's lowest point is at a height, doc/mathematics.md, (16.8). Blocks: object, height (1)
 * [m].
 * \param sigma [m]. */
Factor createFloorFactor(double sigma, double huber, ObjectFreedom freedom);

/** Gaussian knowledge of an object, doc/mathematics.md, (16.9): 1/2 d^t L d + g^t d with d the
 * increment from `at`. Block: object.
 * L may be singular (positive semidefinite). */
struct ObjectPrior
{
  ObjectBlock at{};
  Eigen::MatrixXd L;
  Eigen::VectorXd g;
  /** Scale c of Cauchy's kernel of the whole residual r, for knowledge that may be wrong [sigmas]:
   * |r|^2 becomes c^2 ln(1 + |r|^2 / c^2), doc/mathematics.md, (19.8). 0: there is no kernel. */
  double cauchy = 0;
};
Factor createObjectPrior(const ObjectPrior& prior, ObjectFreedom freedom);

}  // namespace quadmap
