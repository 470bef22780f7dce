#include "quadmap/points/PointTypes.h"

#include <cmath>

#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
template <>
PointMatrix<2> rotationBy<2>(const TurnVector<2>& turn)
{
  return Eigen::Rotation2Dd(turn[0]).toRotationMatrix();
}

template <>
PointMatrix<3> rotationBy<3>(const TurnVector<3>& turn)
{
  return rotationOf(turn).toRotationMatrix();
}

template <>
TurnVector<2> turnOf<2>(const PointMatrix<2>& R)
{
  return TurnVector<2>(std::atan2(R(1, 0), R(0, 0)));
}

template <>
TurnVector<3> turnOf<3>(const PointMatrix<3>& R)
{
  return rotationVectorOf(Eigen::Quaterniond(R));
}

template <>
Eigen::Matrix<double, 2, 1> movedByTurn<2>(const PointVector<2>& v)
{
  return {-v.y(), v.x()};
}

template <>
Eigen::Matrix<double, 3, 3> movedByTurn<3>(const PointVector<3>& v)
{
  return -crossMatrix(v);
}

}  // namespace quadmap
