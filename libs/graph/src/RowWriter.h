#pragma once

#include <Eigen/Dense>
#include <cstddef>

#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/estimation/RobustKernel.h"
#include "quadmap/graph/GraphState.h"

namespace quadmap
{
/** Puts rows into the arrays of Ceres: derivatives by increments become derivatives by the entries
 * of the blocks (GraphState.h). */
class RowWriter
{
 public:
  /** \param object The object's block, with this freedom. \param residuals Of Ceres. */
  RowWriter(const double* object, ObjectFreedom freedom, double* residuals) :
      object_(object), residuals_(residuals), freedom_(freedom)
  {
  }

  /** \param jacobian Row major, one column per entry of the block; null: it is not wanted. */
  void writePoseJacobian(const double* pose, double* jacobian)
  {
    poseJacobian_ = jacobian;
    if (jacobian)
      poseTurn_ = rotationIncrementPerQuaternion(Eigen::Map<const Eigen::Quaterniond>(pose));
  }
  void writeObjectJacobian(double* jacobian)
  {
    objectJacobian_ = jacobian;
    if (jacobian && freedom_ == ObjectFreedom::Free)
      objectTurn_ =
          rotationIncrementPerQuaternion(Eigen::Map<const Eigen::Quaterniond>(object_ + 3));
  }

  /** Writes the next row. \param robust The row's residual, in sigmas, under its kernel. */
  void add(const ResidualRow& row, double sigma, const RobustRow& robust)
  {
    residuals_[index_] = robust.value;
    const double slope = robust.slope / sigma;
    if (poseJacobian_)
    {
      Eigen::Map<Eigen::Matrix<double, 1, 7>> J(poseJacobian_ + 7 * index_);
      J << slope * row.d_poseTurn.transpose() * poseTurn_, slope * row.d_poseMove.transpose();
    }
    if (objectJacobian_) addObject(row, slope);
    ++index_;
  }

 private:
  void addObject(const ResidualRow& row, double slope)
  {
    if (freedom_ == ObjectFreedom::Upright)
    {
      Eigen::Map<Eigen::Matrix<double, 1, 7>> J(objectJacobian_ + 7 * index_);
      J = slope * row.byUprightState().transpose();
      return;
    }
    Eigen::Map<Eigen::Matrix<double, 1, 10>> J(objectJacobian_ + 10 * index_);
    J << slope * row.d_objectMove.transpose(), slope * row.d_objectTurn.transpose() * objectTurn_,
        slope * row.d_logSizes.transpose();
  }

  const double* object_;
  double* residuals_;
  ObjectFreedom freedom_;
  double *poseJacobian_ = nullptr, *objectJacobian_ = nullptr;
  using TurnPerQuaternion = Eigen::Matrix<double, 3, 4>;
  TurnPerQuaternion poseTurn_ = TurnPerQuaternion::Zero(), objectTurn_ = TurnPerQuaternion::Zero();
  std::ptrdiff_t index_ = 0;
};

}  // namespace quadmap
