#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "SyntheticScene.h"
#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap::testing
{
inline mrpt::math::TPoint3D pointOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/** One of several poses on a circle, from where a camera looks at its centre. */
inline mrpt::poses::CPose3D poseAround(
    int i,
    int frames,
    const Eigen::Vector3d& center = {0, 0, 0.5},
    double radius = 2.6,
    double height = 1.5)
{
  const double angle = 2 * M_PI * i / frames;
  const Eigen::Vector3d eye(
      center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle), height);
  return SyntheticCamera::lookAt(eye, center);
}

/** Walks around a scene, looking at its centre, and inserts what the camera sees. */
inline void walkAround(
    CQuadricObjectMap& map,
    SyntheticCamera& camera,
    const std::vector<TrueObject>& world,
    int frames,
    const Eigen::Vector3d& center = {0, 0, 0.5},
    double radius = 2.5,
    double height = 1.5)
{
  for (int i = 0; i < frames; ++i)
  {
    const auto T_map_sensor = poseAround(i, frames, center, radius, height);
    map.insertObservation(camera.observe(T_map_sensor, world), camera.disturbed(T_map_sensor));
  }
}

/** Every true object is confirmed once, at its place, and nothing else is. */
inline void expectMapOf(
    const CQuadricObjectMap& map, const std::vector<TrueObject>& world, double meters)
{
  EXPECT_EQ(map.confirmedObjects().size(), world.size()) << map.asString();
  for (const auto& truth : world)
  {
    const MapObject* found = map.nearest(pointOf(truth.object.center()), truth.label);
    ASSERT_TRUE(found) << truth.label << "\n" << map.asString();
    EXPECT_LT((found->object.center() - truth.object.center()).norm(), meters) << truth.label;
  }
}

inline std::vector<TrueObject> kitchen()
{
  return {
      cuboid("dining table", {0, 0, 0.375}, {1.4, 0.9, 0.75}, 0.1),
      cuboid("chair", {1.15, 0.1, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("chair", {-1.15, -0.1, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("chair", {0.35, 0.75, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("chair", {-0.35, 0.75, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("chair", {0, -0.75, 0.45}, {0.45, 0.45, 0.9}, 0.1),
      cuboid("cup", {-0.25, 0, 0.8}, {0.09, 0.09, 0.1}, 0),
      cuboid("cup", {0.25, 0, 0.8}, {0.09, 0.09, 0.1}, 0)};
}

/** A small map built quickly, the same in every test. */
inline CQuadricObjectMap smallMap()
{
  CQuadricObjectMap map;
  SyntheticCamera camera(42);
  walkAround(
      map, camera,
      {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4),
       cuboid("tv", {0.9, 0.8, 0.9}, {0.8, 0.1, 0.5}, 0.2)},
      24);
  map.consolidate();
  return map;
}

}  // namespace quadmap::testing
