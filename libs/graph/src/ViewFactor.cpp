#include <ceres/cost_function.h>

#include "RowWriter.h"
#include "quadmap/estimation/ViewAtPose.h"
#include "quadmap/graph/GraphFactors.h"

namespace quadmap
{
namespace
{
using Eigen::Quaterniond;
using Eigen::Vector3d;

RobotPose robotPoseOf(const double* block)
{
  const Quaterniond q(Eigen::Map<const Quaterniond>{block});
  return {q.normalized().toRotationMatrix(), Eigen::Map<const Vector3d>(block + 4)};
}

/** The rows of one measurement (doc/mathematics.md, 16), each under its kernel (16.6), (16.7). */
class ViewFactor : public ceres::CostFunction
{
 public:
  ViewFactor(
      const BoxMeasurement& measurement,
      double shapeExponent,
      double huber,
      ObjectFreedom freedom) :
      measurement_(measurement), shapeExponent_(shapeExponent), huber_(huber), freedom_(freedom)
  {
    set_num_residuals(static_cast<int>(ViewAtPose::rowCount(measurement, freedom)));
    *mutable_parameter_block_sizes() = {7, blockSize(freedom)};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override
  {
    RowWriter out(blocks[1], freedom_, residuals);
    auto derivatives = RowDerivatives::OfObject;
    if (jacobians)
    {
      out.writePoseJacobian(blocks[0], jacobians[0]);
      out.writeObjectJacobian(jacobians[1]);
      if (jacobians[0]) derivatives = RowDerivatives::OfObjectAndPose;
    }
    const ViewAtPose view(measurement_, robotPoseOf(blocks[0]), freedom_, derivatives);
    view.forEachRow(
        shapeOf(blocks[1], freedom_), shapeExponent_, {huber_},
        [&](const ResidualRow& row, double sigma, const RobustKernel& kernel)
        { out.add(row, sigma, kernel.row(row.r / sigma, measurement_.weight)); });
    return true;
  }

 private:
  const BoxMeasurement& measurement_;
  double shapeExponent_, huber_;
  ObjectFreedom freedom_;
};

}  // namespace

Factor createViewFactor(
    const BoxMeasurement& measurement, double shapeExponent, double huber, ObjectFreedom freedom)
{
  return std::make_unique<ViewFactor>(measurement, shapeExponent, huber, freedom);
}

}  // namespace quadmap
