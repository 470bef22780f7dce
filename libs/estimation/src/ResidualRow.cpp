#include "quadmap/estimation/ResidualRow.h"

#include "quadmap/geometry/Support.h"

namespace quadmap
{
TangencyRow tangencyRow(
    const Eigen::Vector3d& n, double distance, const ObjectShape& object, double q)
{
  const Eigen::Vector3d n_obj = object.R.transpose() * n;
  const auto support = supportWithDerivatives(n_obj, object.s, q);
  TangencyRow row;
  row.r = distance - support.h;  // (3.5)
  row.d_objectMove = n;          // (3.6) from here on
  row.d_objectTurn = object.R * n_obj.cross(support.d_n);
  row.d_logSizes = -support.d_s.cwiseProduct(object.s);
  row.gradient = object.R * support.d_n;
  return row;
}

double tangencyResidual(const Plane& plane, const Ellipsoid& object, double q)
{
  const ObjectShape shape(object.center(), object.rotation(), object.semiAxes());
  return tangencyRow(plane.n, plane.signedDistance(shape.t), shape, q).r;
}

TangencyRow faceRow(
    const Eigen::Vector3d& inward,
    const Eigen::Vector3d& fromCenter,
    double half,
    const ObjectShape& object,
    double q)
{
  return tangencyRow(inward, inward.dot(fromCenter) + half, object, q);  // (11.2)
}

void addPoseDerivatives(const Eigen::Vector3d& n, const Eigen::Vector3d& toObject, TangencyRow& row)
{
  row.d_poseMove = -n;  // (16.3)
  row.d_poseTurn = n.cross(toObject - row.gradient);
}

}  // namespace quadmap
