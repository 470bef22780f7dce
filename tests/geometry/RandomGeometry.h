#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <random>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/PinholeCamera.h"

namespace quadmap::test
{
inline mrpt::poses::CPose3D poseOf(const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
{
  mrpt::math::CMatrixDouble44 T;
  T.setIdentity();
  T.asEigen().topLeftCorner<3, 3>() = R;
  T.asEigen().topRightCorner<3, 1>() = t;
  return mrpt::poses::CPose3D(T);
}

/** Reproducible random geometry. */
class RandomGeometry
{
 public:
  explicit RandomGeometry(unsigned seed) : engine_(seed) {}

  double uniform(double min, double max)
  {
    return std::uniform_real_distribution<double>(min, max)(engine_);
  }
  Eigen::Vector3d vector(double min, double max)
  {
    const double x = uniform(min, max), y = uniform(min, max), z = uniform(min, max);
    return {x, y, z};
  }
  Eigen::Vector3d direction()
  {
    std::normal_distribution<double> normal;
    const double x = normal(engine_), y = normal(engine_), z = normal(engine_);
    return Eigen::Vector3d(x, y, z).normalized();
  }
  Eigen::Matrix3d rotation()
  {
    return Eigen::AngleAxisd(uniform(-M_PI, M_PI), direction()).toRotationMatrix();
  }
  mrpt::poses::CPose3D pose(double range)
  {
    const Eigen::Matrix3d R = rotation();
    return poseOf(R, vector(-range, range));
  }
  Ellipsoid ellipsoid(const Eigen::Vector3d& center)
  {
    const Eigen::Matrix3d R = rotation();
    return Ellipsoid(poseOf(R, center), vector(0.1, 0.6));
  }

 private:
  std::mt19937 engine_;
};

/** A point of the unit sphere mapped to the surface of an ellipsoid, in its reference frame. */
inline Eigen::Vector3d surfacePoint(const Ellipsoid& object, const Eigen::Vector3d& unit)
{
  return object.rotation() * object.semiAxes().cwiseProduct(unit) + object.center();
}

inline PinholeCamera kinectCamera() { return {525, 525, 319.5, 239.5, 640, 480}; }
/** ICL-NUIM: the image is upside down in the camera's frame. */
inline PinholeCamera iclCamera() { return {481.2, -480, 319.5, 239.5, 640, 480}; }

}  // namespace quadmap::test
