#include "quadmap/estimation/ViewAtPose.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

ViewAtPose::ViewAtPose(
    const BoxMeasurement& measurement,
    const RobotPose& pose,
    ObjectFreedom freedom,
    RowDerivatives derivatives) :
    m_(measurement),
    pose_(pose),
    freedom_(freedom),
    withPose_(derivatives == RowDerivatives::OfObjectAndPose),
    axes_(pose.R * measurement.axes),
    measuredUp_(axes_.col(2)),
    fromRobot_(pose.R * measurement.center)
{
  if (freedom == ObjectFreedom::Free || !measurement.complete) return;
  // The cuboid is turned upright about its centre. Its normals then follow only the yaw of the
  // pose.
  const Vector3d u = axes_.col(0);
  const double horizontal2 = u.head<2>().squaredNorm();
  yaw_ = std::atan2(u.y(), u.x());
  d_yaw_ = Vector3d(-u.x() * u.z(), -u.y() * u.z(), horizontal2) / horizontal2;
  axes_ = Eigen::AngleAxisd(yaw_, Vector3d::UnitZ()).toRotationMatrix();
}

std::size_t ViewAtPose::rowCount(const BoxMeasurement& m, ObjectFreedom freedom)
{
  const auto faces = std::count_if(
      m.faces.begin(), m.faces.end(), [](const auto& f) { return f.kind != FaceKind::Unknown; });
  const int angles = (hasYawRow(m, freedom) ? 1 : 0) + tiltRows(m, freedom) + turnRows(m, freedom);
  return (m.complete ? static_cast<std::size_t>(faces) : 0) + static_cast<std::size_t>(angles) +
         m.edges.size() + (m.hasSeed ? 3 : 0);
}

ResidualRow ViewAtPose::face(std::size_t f, const ObjectShape& object) const
{
  const auto axis = static_cast<Eigen::Index>(f / 2);
  // The face's plane with its normal turned inwards, towards the object.
  const Vector3d n = (f % 2 == 0 ? -1.0 : 1.0) * axes_.col(axis);
  const Vector3d toObject = object.t - pose_.t;
  const Vector3d fromCenter = toObject - fromRobot_;
  TangencyRow row = faceRow(n, fromCenter, m_.halfSizes[axis], object, m_.faceExponent);
  if (!withPose_) return row;
  if (freedom_ == ObjectFreedom::Free)
  {
    addPoseDerivatives(n, toObject, row);
    return row;
  }
  // The pose turns the normal about the measured centre by its yaw alone, and carries the centre.
  row.d_poseMove = -n;
  row.d_poseTurn = d_yaw_ * n.cross(fromCenter - row.gradient).z() + Vector3d(n.cross(fromRobot_));
  return row;
}

ResidualRow ViewAtPose::yaw(const ObjectShape& object) const
{
  ResidualRow row;
  row.r = object.yaw - nearestEquivalentYaw(yaw_, object.yaw);
  row.d_objectTurn = Vector3d::UnitZ();
  if (withPose_) row.d_poseTurn = -d_yaw_;
  return row;
}

ResidualRow ViewAtPose::tilt(int axis) const
{
  ResidualRow row;
  row.r = measuredUp_[axis];
  if (withPose_) row.d_poseTurn = measuredUp_.cross(Vector3d::Unit(axis));
  return row;
}

ResidualRow ViewAtPose::turn(int axis, const ObjectShape& object) const
{
  const Matrix3d measured = axes_ * symmetricRotationDistance(object.R, axes_).relabeling;
  const Vector3d e =
      rotationVectorOf(Eigen::Quaterniond(Matrix3d(object.R * measured.transpose())));
  const Vector3d a = axes_.col(axis);
  ResidualRow row;
  row.r = a.dot(e);
  row.d_objectTurn = inverseLeftJacobian(e).transpose() * a;
  if (withPose_) row.d_poseTurn = -inverseLeftJacobian(-e).transpose() * a + a.cross(e);
  return row;
}

ResidualRow ViewAtPose::edge(
    const BoxMeasurement::Edge& e, const ObjectShape& object, double q) const
{
  const Vector3d n = pose_.R * e.normal, camera = pose_.R * m_.camera;
  const Vector3d toObject = object.t - pose_.t;
  TangencyRow row = tangencyRow(n, n.dot(toObject - camera), object, q);
  if (withPose_) addPoseDerivatives(n, toObject, row);
  return row;
}

ResidualRow ViewAtPose::seed(int i, const ObjectShape& object) const
{
  const Vector3d m = pose_.R * m_.seedWhitening.row(i).transpose();
  const Vector3d toObject = object.t - pose_.t;
  ResidualRow row;
  row.r = m.dot(toObject - fromRobot_);
  row.d_objectMove = m;
  if (!withPose_) return row;
  row.d_poseTurn = m.cross(toObject);
  row.d_poseMove = -m;
  return row;
}

}  // namespace quadmap
