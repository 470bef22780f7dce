#pragma once

#include <string>

#include "../maps/SyntheticScene.h"
#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
inline CQuadricObjectMap mapFrom(const std::string& file)
{
  CQuadricObjectMap map;
  map.loadFromFile(file);
  return map;
}

/** A chair, a couch and a refrigerator, seen from all around with millimetres of noise. */
inline CQuadricObjectMap sampleMap()
{
  const std::vector<testing::TrueObject> world = {
      testing::cuboid("chair", {1.0, 0.5, 0.45}, {0.5, 0.5, 0.9}, 0.3),
      testing::cuboid("couch", {-1.5, 1.0, 0.4}, {0.8, 1.8, 0.8}, 0.1),
      testing::cuboid("refrigerator", {0.5, -1.8, 0.9}, {0.6, 0.7, 1.8}, -0.5)};
  testing::SyntheticCamera camera(1);
  camera.disturbances = {0.002, 0.01, 0, 0, 0};
  CQuadricObjectMap map;
  for (const auto& truth : world)
    for (int i = 0; i < 24; ++i)
    {
      const double a = 2 * M_PI * i / 24;
      const Eigen::Vector3d target = truth.object.center();
      const Eigen::Vector3d eye = target + Eigen::Vector3d(3 * std::cos(a), 3 * std::sin(a), 1.0);
      const auto T_map_sensor = testing::SyntheticCamera::lookAt(eye, target);
      map.insertObservation(camera.observe(T_map_sensor, {truth}), T_map_sensor);
    }
  map.consolidate();
  return map;
}

}  // namespace quadmap
