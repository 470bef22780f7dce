#include "quadmap/geometry/PinholeCamera.h"

#include <gtest/gtest.h>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

TEST(PinholeCamera, ProjectsByItsMatrix)
{
  RandomGeometry random(7);
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (int i = 0; i < 20; ++i)
    {
      const Eigen::Vector3d p = random.vector(-1, 1) + Eigen::Vector3d(0, 0, 3);
      const Eigen::Vector3d h = camera.matrix() * p;
      EXPECT_LT((camera.project(p) - h.head<2>() / h.z()).norm(), 1e-10);
    }
}

TEST(PinholeCamera, RayOfAPixelProjectsBackToIt)
{
  for (const PinholeCamera& camera : {kinectCamera(), iclCamera()})
    for (double u : {0.0, 123.4, 639.0})
      for (double v : {0.0, 300.5, 479.0})
      {
        EXPECT_LT((camera.project(2.5 * camera.ray(u, v)) - Eigen::Vector2d(u, v)).norm(), 1e-10);
        EXPECT_EQ(camera.ray(u, v).z(), 1);
      }
}

TEST(PinholeCamera, OpticalFrameLooksAlongTheSensorsX)
{
  const Eigen::Matrix3d R = T_sensor_optical().getRotationMatrix().asEigen();
  EXPECT_EQ(R * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()) << "forward";
  EXPECT_EQ(R * Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY()) << "right";
  EXPECT_EQ(R * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()) << "down";
  EXPECT_EQ(T_sensor_optical().norm(), 0);
  const mrpt::poses::CPose3D documented(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  EXPECT_LT((documented.getRotationMatrix().asEigen() - R).norm(), 1e-15);
}
