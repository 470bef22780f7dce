#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "quadmap/geometry/Projection.h"
#include "quadmap/quadric/BoxView.h"
#include "quadmap/quadric/QuadricInitialisation.h"

namespace quadmap::testing
{
inline const PinholeCamera kVga{525, 525, 319.5, 239.5, 640, 480};

/** x forward, looking from `eye` to `target`. */
inline mrpt::poses::CPose3D lookingAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target)
{
  const Eigen::Vector3d d = target - eye;
  return {
      eye.x(), eye.y(), eye.z(), std::atan2(d.y(), d.x()), std::atan2(-d.z(), d.head<2>().norm()),
      0};
}

constexpr double kEdgeSigma = 3.0 / 525;  //!< Of the edges that viewOf() makes [rad]

/** A camera 0.6 m above a robot that drives around a point at 2.5 m, looking at it. */
inline mrpt::poses::CPose3D robotOnCircle(const Eigen::Vector3d& center, double angle)
{
  const Eigen::Vector3d eye =
      center + Eigen::Vector3d(2.5 * std::cos(angle), 2.5 * std::sin(angle), 0);
  return {eye.x(), eye.y(), 0, angle + M_PI, 0, 0};
}
inline mrpt::poses::CPose3D robotCamera() { return {0.1, 0, 1.1, 0, 0.25, 0}; }

/** What the robot's camera has of an ellipsoid. \param error Of its edges left, top, right, bottom
 * [px]. */
inline BoxView viewOf(
    const Ellipsoid& object,
    const mrpt::poses::CPose3D& T_map_robot,
    std::size_t keyframe,
    const Eigen::Vector4d& error = Eigen::Vector4d::Zero())
{
  const auto T_robot_optical = robotCamera() + T_sensor_optical();
  ImageBox box = *projectEllipsoidBox(kVga, object.transformed(-(T_map_robot + T_robot_optical)));
  box = {box.x1 + error[0], box.y1 + error[1], box.x2 + error[2], box.y2 + error[3]};
  BoxView view;
  view.keyframe = keyframe;
  view.label = "chair";
  view.camera = {T_robot_optical.x(), T_robot_optical.y(), T_robot_optical.z()};
  const auto planes = boxEdgePlanes(kVga, box);
  for (std::size_t e = 0; e < 4; ++e)
    view.edges[e] = {planes[e].transformed(T_robot_optical).n, kEdgeSigma, true};
  return view;
}

/** The box of the outline, with Gaussian noise on its edges [px]. */
inline PlacedBox boxOf(
    const Ellipsoid& object,
    const mrpt::poses::CPose3D& T_map_sensor,
    double sigma_px = 0,
    std::mt19937* random = nullptr)
{
  const auto T_map_optical = T_map_sensor + T_sensor_optical();
  ImageBox box = *projectEllipsoidBox(kVga, object.transformed(-T_map_optical));
  if (random)
    for (double* edge : {&box.x1, &box.y1, &box.x2, &box.y2})
      *edge += std::normal_distribution<double>(0, sigma_px)(*random);
  PlacedBox placed;
  placed.camera = {T_map_sensor.x(), T_map_sensor.y(), T_map_sensor.z()};
  const auto planes = boxEdgePlanes(kVga, box);
  for (std::size_t e = 0; e < 4; ++e)
  {
    placed.edges[e] = planes[e].transformed(T_map_optical);
    placed.usable[e] = true;
  }
  return placed;
}

/** An arc around the object, looking at it. \param arc [rad]. */
inline std::vector<PlacedBox> boxesOnArc(
    const Ellipsoid& object,
    int views,
    double arc,
    double sigma_px = 0,
    std::mt19937* random = nullptr)
{
  std::vector<PlacedBox> boxes;
  for (int i = 0; i < views; ++i)
  {
    const double angle = 0.3 + arc * i / std::max(1, views - 1);
    const Eigen::Vector3d eye = object.center() + Eigen::Vector3d(
                                                      2.5 * std::cos(angle), 2.5 * std::sin(angle),
                                                      0.6 + 0.3 * std::sin(3 * angle));
    boxes.push_back(boxOf(object, lookingAt(eye, object.center()), sigma_px, random));
  }
  return boxes;
}

}  // namespace quadmap::testing
