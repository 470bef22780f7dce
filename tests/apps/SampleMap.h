#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <memory>
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

/** Calls `use` with the pose of a camera and what it sees of a chair, a couch, a refrigerator and
 * of `more`, from all around with millimetres of noise. */
template <typename F>
void forEachViewOfSample(F&& use, const std::vector<testing::TrueObject>& more = {})
{
  std::vector<testing::TrueObject> world = {
      testing::cuboid("chair", {1.0, 0.5, 0.45}, {0.5, 0.5, 0.9}, 0.3),
      testing::cuboid("couch", {-1.5, 1.0, 0.4}, {0.8, 1.8, 0.8}, 0.1),
      testing::cuboid("refrigerator", {0.5, -1.8, 0.9}, {0.6, 0.7, 1.8}, -0.5)};
  world.insert(world.end(), more.begin(), more.end());
  testing::SyntheticCamera camera(1);
  camera.disturbances = {0.002, 0.01, 0, 0, 0};
  for (const auto& truth : world)
    for (int i = 0; i < 24; ++i)
    {
      const double a = 2 * M_PI * i / 24;
      const Eigen::Vector3d target = truth.object.center();
      const Eigen::Vector3d eye = target + Eigen::Vector3d(3 * std::cos(a), 3 * std::sin(a), 1.0);
      const auto T_map_sensor = testing::SyntheticCamera::lookAt(eye, target);
      use(T_map_sensor, camera.observe(T_map_sensor, {truth}));
    }
}

inline CQuadricObjectMap sampleMap(const std::vector<testing::TrueObject>& more = {})
{
  CQuadricObjectMap map;
  forEachViewOfSample(
      [&](const auto& T_map_sensor, const CObservationObjects& seen)
      { map.insertObservation(seen, T_map_sensor); },
      more);
  map.consolidate();
  return map;
}

/** The same views as keyframes. */
inline mrpt::maps::CSimpleMap simpleMapOfSample()
{
  mrpt::maps::CSimpleMap keyframes;
  forEachViewOfSample(
      [&](const auto& T_map_sensor, const CObservationObjects& seen)
      {
        mrpt::obs::CSensoryFrame frame;
        frame.insert(std::make_shared<CObservationObjects>(seen));
        keyframes.insert(mrpt::poses::CPose3DPDFGaussian(T_map_sensor), frame);
      });
  return keyframes;
}

}  // namespace quadmap
